from roslens.model.finding import Severity
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.type import found
from testbed.configured import configuration, end, node


def findings(*nodes):
    return list(found(configuration(*nodes), Surroundings()))


def test_the_rarer_type_is_found_fault_with():
    (one,) = findings(
        node("/a", end("pub", "/p", "geometry_msgs/msg/Pose", 3)),
        node("/b", end("sub", "/p", "geometry_msgs/msg/Pose", 4)),
        node("/c", end("sub", "/p", "geometry_msgs/msg/PoseStamped", 5)),
    )
    assert one.severity is Severity.ERROR
    assert (one.path, one.line) == ("src/c.cpp", 5)
    assert "topic /p has 2 types: /a (src/a.cpp:3) publishes it, /b (src/b.cpp:4) subscribes to it as" in one.message


def test_services_and_topics_of_one_name_are_two_things():
    assert not findings(node("/a", end("pub", "/p", "a_msgs/msg/A")), node("/b", end("serve", "/p", "a_msgs/srv/B")))


def test_unknown_types_and_those_that_stand_for_any_fit():
    assert not findings(
        node("/a", end("pub", "/p", "a_msgs/msg/A")),
        node("/b", end("sub", "/p", "")),
        node("/c", end("sub", "/p", "topic_tools/ShapeShifter")),
        node("/d", end("sub", "/p", "*")),
    )


def test_implicit_ends_are_left_out():
    from roslens.model.configuration import Origin

    assert not findings(
        node("/a", end("pub", "/p", "a_msgs/msg/A", origin=Origin.IMPLICIT)),
        node("/b", end("sub", "/p", "a_msgs/msg/B")),
    )


def test_of_one_node_only_one_type_is_there_under_opposite_conditions():
    both = (
        end("pub", "/cmd", "g/msg/TwistStamped", 3, conditions=("is_stamped_",)),
        end("pub", "/cmd", "g/msg/Twist", 4, conditions=("not is_stamped_",)),
    )
    assert not findings(node("/a", *both))
    (one,) = findings(node("/a", *both), node("/b", end("sub", "/cmd", "g/msg/Twist", 5)))
    assert "TwistStamped another name" in one.message
    assert one.severity is Severity.NOTE
    assert "/a has it with each of these types, and may choose the one that fits" in one.message


def test_where_one_node_chooses_the_others_still_have_to_fit():
    ways = [end("sub", "/scan", kind, 3, sure="likely") for kind in ("s/msg/Scan", "s/msg/Cloud")]
    chooser = node("/a", *ways)
    scan, cloud = node("/b", end("pub", "/scan", "s/msg/Scan", 5)), node("/c", end("sub", "/scan", "s/msg/Cloud", 6))
    (one,) = findings(chooser, scan, cloud)
    assert (one.severity, one.path) == (Severity.ERROR, "src/b.cpp")
    (one,) = findings(node("/a", end("pub", "/x", "s/msg/A", 3), end("pub", "/x", "s/msg/B", 4)))
    assert one.severity is Severity.ERROR, "one node that has both for sure"


def test_words_of_two_nodes_are_two_values():
    (one,) = findings(
        node("/a", end("pub", "/cmd", "g/msg/Twist", 3, conditions=("not is_stamped_", "#if A"))),
        node("/b", end("sub", "/cmd", "g/msg/TwistStamped", 4, conditions=("is_stamped_", "#if A"))),
    )
    assert one.severity is Severity.NOTE
    assert "only if `not is_stamped_ in /a` and `#if A` and `is_stamped_ in /b`; if both nodes" in one.message


def test_a_type_of_the_same_definition_under_another_name_is_the_same():
    ends = [end("pub", "/tf", "tf/tfMessage"), end("sub", "/tf", "tf2_msgs/TFMessage")]
    assert not findings(*(node(f"/{place}", one) for place, one in enumerate(ends)))
