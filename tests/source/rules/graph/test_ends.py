from roslens.model.configuration import Origin, Proof
from roslens.source.rules.graph.ends import by_name, ends, is_launched, listed, unknown_nodes, unresolved_ends
from testbed.configured import configuration, end, node, timer

KNOWN = configuration(
    node(
        "/a",
        end("pub", "/x", sure="likely"),
        end("pub", "/*", resolved=False),
        end("pub", "/i", origin=Origin.IMPLICIT),
    ),
    node("/b*", end("sub", "/x"), resolved=False),
    node("/c", end("sub", "/x"), known=False, proof=Proof("CMakeLists.txt", 1)),
)


def test_only_known_names_of_code_are_ends():
    assert [(one.node.name, one.name) for one in ends(KNOWN)] == [("/a", "/x"), ("/c", "/x")]
    assert [(one.node.name, one.name) for one in unresolved_ends(KNOWN)] == [("/a", "/*"), ("/b*", "/x")]


def test_the_clearest_comes_first():
    assert [one.node.name for one in by_name(ends(KNOWN))["topic", "/x"]] == ["/c", "/a"]


def test_what_is_known_of_nodes():
    assert [one.name for one in unknown_nodes(KNOWN)] == ["/c"]
    silent = node("/s", end("pub", "/tf", line=0))
    assert [one.name for one in unknown_nodes(configuration(silent, node("/t", timers=(timer(1.0),))))] == ["/s"]
    assert is_launched(KNOWN)
    assert not is_launched(configuration())


def test_an_end_tells_its_place():
    one = ends(KNOWN)[0]
    assert (one.label, one.entity) == ("/a (src/a.cpp:1)", "topic:/x")


def test_an_end_of_an_installed_node_is_at_the_place_that_starts_it():
    known = end("pub", "/x", path="org/project: src/a.cpp", line=0, origin=Origin.CATALOGUE)
    (one,) = ends(configuration(node("/a", known, line=7)))
    assert (one.label, one.where.place) == ("/a (launch/robot.launch.xml:7)", "launch/robot.launch.xml:7")


def test_lists_are_cut():
    assert listed(["a", "b", "a"]) == "a, b"
    assert listed(["a", "b", "c", "d", "e"]) == "a, b, c and 2 more"
