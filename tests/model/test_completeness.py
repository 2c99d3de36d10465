"""How much of a computation graph is known: nodes whole, in part and by name only, and the reasons."""

from roslens.model.configuration import (
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    Missing,
    Origin,
    Proof,
    Unresolved,
)
from roslens.model.graph import Endpoint, Role
from roslens.model.graphs.completeness import INCOMPLETE, Completeness, Gap, completeness_of, incomplete

CODE = Proof("talk/src/talk.cpp", 7)


def started(line):
    return Proof("talk/launch/all.launch.py", line, 5, origin=Origin.LAUNCH)


def end(name="/chatter"):
    return ConfiguredEndpoint(Endpoint("/talk", Role.PUBLISHER, name, "std_msgs/msg/String"), CODE)


def node(name, line, **more):
    return ConfiguredNode(name, started(line), package="talk", **{"defined": CODE, "endpoints": (end(),), **more})


def graph(*nodes, unresolved=()):
    return Configuration("all", "ros2", nodes, unresolved=tuple(unresolved))


def test_a_graph_of_which_everything_is_known_is_whole():
    known = completeness_of(graph(node("/a", 1), node("/b", 2)))
    assert known == Completeness(whole=2)
    assert (known.is_whole, known.said(), list(known.why())) == (True, "2 of 2 nodes complete", [])


def test_a_node_whose_package_is_elsewhere_is_known_by_name_and_the_package_is_named():
    lost = Unresolved(
        "drv/arm", started(2), "package drv is not in the workspace; its endpoints are unknown", outside=("drv",)
    )
    known = completeness_of(graph(node("/a", 1), node("/b", 2, defined=None, endpoints=()), unresolved=(lost,)))
    assert (known.whole, known.named, known.part, known.unread) == (1, 1, 0, 0)
    assert known.gaps == (Gap("drv is not in the workspace", 1, ("drv",)),)
    assert known.said() == "1 of 2 nodes complete, 1 known by name only"
    assert [*known.why()][-1].startswith("roslens fetch --distro DISTRO --package drv ")


def test_a_node_is_known_in_part_where_a_name_or_every_endpoint_is_missing():
    missed = Unresolved("name", CODE, "the name depends on a file", node="/a")
    known = completeness_of(graph(node("/a", 1), node("/b", 2, endpoints=()), unresolved=(missed,)))
    assert (known.whole, known.part) == (0, 2)
    assert {gap.reason for gap in known.gaps} == {
        "parts of its code could not be evaluated",
        "no endpoint was found in its code",
    }
    assert not known.is_unread


def test_what_belongs_to_no_node_is_counted_and_keeps_a_graph_from_being_whole():
    opens = Unresolved("include", started(9), "package x is not in the workspace", opens=True)
    loose = Unresolved("create()", CODE, "no evaluated code calls it")
    vendored = Unresolved("create()", CODE, "no evaluated code calls it", role="vendored")
    alike = Unresolved("create()", CODE, "it makes none", missing=Missing.NAMED_ALIKE)
    known = completeness_of(graph(node("/a", 1), unresolved=(opens, loose, vendored, alike)))
    assert (known.missing, known.unread, known.is_whole) == (1, 1, False)
    assert known.said() == "1 of 1 node complete, 1 place may start more, 1 more place could not be evaluated"


def test_programs_that_are_no_nodes_do_not_count_and_nodes_of_the_catalogue_are_whole():
    catalogue = Proof("https://github.com/ros/x", origin=Origin.CATALOGUE)
    process = node("/p", 3, kind="process", defined=None, endpoints=())
    known = completeness_of(graph(node("/joy", 1, defined=catalogue), process))
    assert (known.nodes, known.whole) == (1, 1)


def test_the_failure_of_a_run_names_the_least_known_graph():
    whole, lost = (
        Completeness(whole=3),
        Completeness(whole=1, named=3, gaps=(Gap("drv is not in the workspace", 3, ("drv",)),)),
    )
    assert incomplete({"a": whole}) is None
    assert incomplete({"empty": Completeness(missing=1)}) is None
    failure = incomplete({"a": whole, "b": lost})
    assert (failure.tool, failure.partial) == (INCOMPLETE, True)
    assert failure.what == (
        "4 of 7 nodes of 2 computation graphs complete; least of b: 1 of 4 nodes complete, 3 known by name only"
    )
    assert "3 nodes: drv is not in the workspace" in failure.advice
