from roslens.model.finding import Severity
from roslens.source.rules.graph.remap import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, node, remap


def findings(*nodes, external=()):
    return list(found(configuration(*nodes), Surroundings(external=external)))


def test_a_remapping_that_matches_nothing_is_told_with_what_was_meant():
    (one,) = findings(node("/a", end("pub", "/cmd_vel", given="cmd_vel"), remaps=(remap("cmd_vle", "drive", 12),)))
    assert (one.path, one.line) == ("launch/robot.launch.xml", 12)
    assert one.message == "remapping of `cmd_vle` to `drive`: /a uses no such name. Did you mean `cmd_vel`?"


def test_one_that_is_used_or_may_be_is_none():
    assert not findings(
        node("/a", remaps=(remap("x", "y", used=True), remap("p", "q", 2, uncertain=True))),
        node("/b", known=False, remaps=(remap("m", "n", 3),)),
    )


X = end("pub", "/p")
GROUP = remap("x", "y")


def test_a_remapping_of_a_group_needs_one_node_that_it_is_for():
    assert not findings(node("/a", remaps=(remap("x", "y", used=True),)), node("/b", X, remaps=(GROUP,)))
    (one,) = findings(node("/a", X, remaps=(GROUP,)), node("/b", X, remaps=(GROUP,)))
    assert "/a, /b use no such name" in one.message
    assert (one.entity, one.also) == ("node:/a", ("node:/b",))


def test_a_name_mapped_to_itself_and_code_that_says_nothing_are_none():
    assert not findings(node("/a", X, remaps=(remap("x", "x"),)), node("/b", remaps=(remap("x", "y", 2),)))


def test_a_remapping_that_stands_behind_the_node_that_has_the_name():
    group = remap("camera/left", "left_camera", uncertain=True)
    simulator = node("/gazebo", end("pub", "/camera/left/image_raw"), line=36)
    (one,) = findings(simulator, node("/a", known=False, remaps=(group,)), node("/b", known=False, remaps=(group,)))
    assert (one.rule, one.entity, one.severity.value) == ("graph.remap", "node:/gazebo", "note")
    assert "applies to 2 nodes" in one.message
    assert "/gazebo (launch/robot.launch.xml:36) does, and is outside of it" in one.message


def test_one_of_a_single_node_or_that_is_used_says_nothing_of_others():
    one = remap("camera/left", "left_camera", uncertain=True)
    simulator = node("/gazebo", end("pub", "/camera/left/image_raw"))
    assert not findings(simulator, node("/a", known=False, remaps=(one,)))
    used = node("/b", remaps=(remap("camera/left", "left_camera", used=True),))
    assert not findings(simulator, node("/a", known=False, remaps=(one,)), used)
    inside = node("/b", end("pub", "/camera/left"), remaps=(one,))
    assert not findings(simulator, node("/a", known=False, remaps=(one,)), inside)


def test_a_node_that_has_the_same_remapping_of_its_own_is_not_out_of_reach():
    group = remap("/tf", "tf", uncertain=True)
    held = [node("/a", known=False, remaps=(group,)), node("/b", known=False, remaps=(group,))]
    one, other = (
        node("/c", end("pub", "/tf"), remaps=(remap("/tf", "tf", 9, used=True),)),
        node("/d", end("pub", "/tf")),
    )
    assert not findings(one, *held)
    (told,) = findings(one, other, *held)
    assert "/d (launch/robot.launch.xml:1) does, and is outside of it" in told.message
    (told,) = findings(node("/e", end("pub", "/tf"), line=7), other, *held)
    assert "do, and are outside of it" in told.message


def test_one_that_is_left_over_is_a_note():
    (one,) = findings(node("/a", X, remaps=(remap("motor_power", "commands/motor_power"),)))
    assert one.severity is Severity.NOTE


def test_who_is_alone_at_the_other_name_is_told():
    base = node("/base", end("sub", "/commands/power", "std_msgs/msg/Bool", line=8))
    (one,) = findings(base, node("/a", X, remaps=(remap("motor_power", "commands/power"),)))
    assert one.severity is Severity.NOTE
    assert "/a uses no such name. /base (src/base.cpp:8) waits for it at `commands/power`." in one.message
    other = node("/other", end("pub", "/commands/power"))
    (one,) = findings(base, other, node("/a", X, remaps=(remap("motor_power", "commands/power"),)))
    assert "waits" not in one.message


def test_a_name_in_another_namespace_was_meant():
    (one,) = findings(node("/a", end("sub", "/a/scan", given="~/scan"), remaps=(remap("scan", "/front/scan"),)))
    assert one.severity is Severity.NOTE
    assert "Did you mean `~/scan`?" in one.message


def test_what_every_node_has_and_what_a_file_gives_all_of_its_nodes():
    assert not findings(node("/a", X, remaps=(remap("/tf", "tf"),)), external=("/tf",))
    one, other = remap("scann", "front/scan", 3, used=True), remap("scann", "front/scan", 9)
    given = node("/b", end("pub", "/scan", given="scan"), remaps=(other,))
    assert [each.severity for each in findings(node("/a", X, remaps=(one,)), given)] == [Severity.NOTE]


def test_one_that_another_one_overtakes_is_told_as_such():
    first, second = remap("x", "y", 3, used=True), remap("x", "z", 4)
    (one,) = findings(node("/a", end("pub", "/y", given="x"), remaps=(first, second)))
    assert (one.line, one.entity) == (4, "node:/a")
    assert one.message == (
        "remapping of `x` to `z` has no effect on /a: that to `y` (launch/robot.launch.xml:3) is applied first. "
        "Remove one of the two."
    )


def test_one_that_is_overtaken_on_one_of_two_nodes_only_is_told_as_one_that_matches_nothing():
    first, second = remap("x", "y", 3, used=True), remap("x", "z", 4)
    (one,) = findings(node("/a", end("pub", "/y", given="x"), remaps=(first, second)), node("/b", X, remaps=(second,)))
    assert "/a, /b use no such name" in one.message


def test_a_free_end_of_the_same_type_was_meant_where_somebody_waits():
    base = node("/base", end("sub", "/base/commands", line=8))
    mux = node("/mux", end("pub", "/mux/output", given="output"), remaps=(remap("mux_cmd_vel", "base/commands"),))
    (one,) = findings(base, mux)
    assert one.severity is Severity.WARNING
    assert "waits for it at `base/commands`. Did you mean `/mux/output`?" in one.message
    (one,) = findings(base, mux, node("/log", end("sub", "/mux/output")))
    assert one.severity is Severity.NOTE
    two = node(
        "/mux",
        end("pub", "/mux/output"),
        end("pub", "/mux/other"),
        end("sub", "/mux/input"),
        remaps=(remap("mux_cmd_vel", "base/commands"),),
    )
    (one,) = findings(base, two)
    assert one.severity is Severity.NOTE
