from roslens.source.rules.graph.remap import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, node, remap


def findings(*nodes):
    return list(found(configuration(*nodes), Surroundings()))


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


def test_a_name_mapped_to_itself_and_code_that_says_nothing_are_none():
    assert not findings(node("/a", X, remaps=(remap("x", "x"),)), node("/b", remaps=(remap("x", "y", 2),)))
