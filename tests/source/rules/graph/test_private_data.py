from roslens.source.rules.graph.private_data import found
from roslens.source.rules.graph.surroundings import Surroundings
from testbed.configured import configuration, end, node


def findings(*nodes):
    return list(found(configuration(*nodes), Surroundings()))


def test_both_ends_in_one_node_are_told():
    (one,) = findings(node("/a", end("pub", "/state", line=3), end("sub", "/state", line=5)))
    assert one.message == "only /a (src/a.cpp:3) itself uses both ends of topic /state. Call it `~/state`."


def test_private_names_shared_ones_and_those_of_two_nodes_are_none():
    assert not findings(
        node(
            "/a", end("pub", "/a/state"), end("sub", "/a/state"), end("pub", "/tf"), end("sub", "/tf"), end("pub", "/x")
        ),
        node("/b", end("pub", "/y"), end("sub", "/y")),
        node("/c", end("sub", "/y")),
    )


def test_nobody_knows_beside_a_node_that_is_not_known():
    assert not findings(node("/a", end("pub", "/state"), end("sub", "/state")), node("/b", known=False))
