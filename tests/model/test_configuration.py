import msgspec

from roslens.model.configuration import (
    Configuration,
    ConfiguredEndpoint,
    ConfiguredNode,
    ConfiguredParameter,
    Origin,
    Proof,
)
from roslens.model.graph import Endpoint, Role

PROOF = Proof("a.cpp", 3)


def node(name: str, *endpoints: ConfiguredEndpoint, **others) -> ConfiguredNode:
    return ConfiguredNode(name, PROOF, endpoints=endpoints, **others)


def end(node_name: str, name: str, origin: Origin = Origin.CODE) -> ConfiguredEndpoint:
    return ConfiguredEndpoint(Endpoint(node_name, Role.PUBLISHER, name), msgspec.structs.replace(PROOF, origin=origin))


def test_places_are_as_far_as_they_are_known():
    assert (PROOF.place, Proof("a.cpp").place) == ("a.cpp:3", "a.cpp")


def test_the_graph_is_sorted_and_may_leave_out_what_every_node_has():
    configuration = Configuration(
        "t", "ros2", (node("/b", end("/b", "/x"), end("/b", "/rosout", Origin.IMPLICIT)), node("/a", end("/a", "/x")))
    )
    assert [one.name for one in configuration.graph().nodes] == ["/a", "/b"]
    assert [(one.node, one.name) for one in configuration.graph(implicit=False).endpoints] == [
        ("/a", "/x"),
        ("/b", "/x"),
    ]


def test_parameters_of_the_graph_are_those_with_a_value():
    one = node("/a", parameters=(ConfiguredParameter("x", "1"), ConfiguredParameter("y")))
    assert Configuration("t", "ros2", (one,)).graph().parameters == {"/a": {"x": "1"}}


def test_nodelets_are_part_of_their_manager_where_it_is_there():
    nodelet = node("/n", end("/n", "/x"), kind="nodelet", container="/m")
    alone = Configuration("t", "ros1", (nodelet,)).graph()
    managed = Configuration("t", "ros1", (nodelet, node("/m"))).graph()
    assert [one.name for one in alone.nodes] == ["/n"]
    assert [(one.node, one.name) for one in managed.endpoints] == [("/m", "/x")]


def test_what_loads_a_nodelet_is_a_node_beside_the_manager():
    ends = (end("/n", "/x"), end("/n", "/rosout", Origin.IMPLICIT))
    nodelet = node("/n", *ends, kind="nodelet", container="/m", parameters=(ConfiguredParameter("/n/a", "1"),))
    graph = Configuration("t", "ros1", (nodelet, node("/m"))).graph()
    assert [one.name for one in graph.nodes] == ["/m", "/n"]
    assert [(one.node, one.name) for one in graph.endpoints] == [("/m", "/x"), ("/n", "/rosout")]
    assert graph.parameters == {"/n": {"/n/a": "1"}}


def test_a_process_and_its_nodelet_of_one_name_are_one_node():
    pair = (
        node("/p", end("/p", "/rosout", Origin.IMPLICIT), parameters=(ConfiguredParameter("a", "1"),)),
        node("/p", end("/p", "/x"), kind="nodelet", container="/p", parameters=(ConfiguredParameter("b", "2"),)),
    )
    graph = Configuration("t", "ros1", pair).graph()
    assert [one.name for one in graph.nodes] == ["/p"]
    assert graph.parameters == {"/p": {"a": "1", "b": "2"}}
