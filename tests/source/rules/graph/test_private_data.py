from roslens.model.source import Location, Package
from roslens.source.rules.graph.private_data import found, mentions
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, node

OWN = Package("own_msgs", "own_msgs", "own_msgs", Location("own_msgs/package.xml"))


def state(role, line=1, name="/state"):
    return end(role, name, "own_msgs/msg/State", line)


def findings(*nodes, **more):
    return list(found(configuration(*nodes), Surroundings(packages=(OWN,), **more)))


def test_both_ends_in_one_node_are_told():
    (one,) = findings(node("/a", state("pub", 3), state("sub", 5)))
    assert one.message == (
        "only /a (src/a.cpp:3) itself uses both ends of topic /state, and no other file of the workspace names it. "
        "Call it `~/state`, if nothing outside of the workspace uses it."
    )


def test_what_others_may_use_is_none():
    assert not findings(node("/slam", end("pub", "/map", "nav_msgs/msg/Map"), end("sub", "/map", "nav_msgs/msg/Map")))
    assert not findings(node("/a", state("pub"), state("sub")), mentioned=frozenset({"state"}))


def test_files_that_name_it_are_looked_for():
    known = configuration(node("/a", state("pub"), state("sub"), state("pub", 1, "/x"), state("sub", 1, "/x")))
    files = {"src/a.cpp": b"state x", "view.rviz": b"Topic: /state\n", "README.md": b"xx"}
    names = mentions(known, Surroundings(), files, files.get)
    assert [one.name for one in names if one.found_in] == ["state"]


def test_private_names_shared_ones_and_those_of_two_nodes_are_none():
    assert not findings(
        node("/a", *(state(role, name=name) for role in ("pub", "sub") for name in ("/a/state", "/tf")), state("pub")),
        node("/b", state("pub", name="/y"), state("sub", name="/y")),
        node("/c", state("sub", name="/y")),
    )


def test_nobody_knows_beside_a_node_that_is_not_known():
    assert not findings(node("/a", state("pub"), state("sub")), node("/b", known=False))
