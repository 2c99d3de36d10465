from roslens.source.rules.graph.command_topic import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, node

TWIST = "geometry_msgs/msg/Twist"


def findings(*nodes, **surroundings):
    return list(found(configuration(*nodes), Surroundings(**surroundings)))


def test_two_nodes_that_drive_are_told():
    (one,) = findings(node("/joy", end("pub", "/cmd_vel", TWIST, 2)), node("/nav", end("pub", "/cmd_vel", TWIST, 4)))
    assert one.message == (
        "2 nodes publish commands on /cmd_vel: /joy (src/joy.cpp:2), /nav (src/nav.cpp:4). The last message is obeyed; "
        "let a multiplexer choose between them."
    )


def test_one_node_other_topics_and_opposite_conditions_are_none():
    assert not findings(
        node("/nav", end("pub", "/cmd_vel", TWIST), end("pub", "/cmd_vel", TWIST, 2)),
        node("/base", end("sub", "/cmd_vel", TWIST), end("pub", "/odom")),
        node("/other", end("pub", "/odom")),
    )
    assert not findings(
        node("/joy", end("pub", "/cmd_vel", TWIST), conditions=("joy",)),
        node("/nav", end("pub", "/cmd_vel", TWIST), conditions=("not joy",)),
    )


def test_which_topics_command_is_set_by_users():
    nodes = node("/a", end("pub", "/thrust")), node("/b", end("pub", "/thrust"))
    assert not findings(*nodes)
    assert len(findings(*nodes, command_topics=("/thrust",))) == 1
