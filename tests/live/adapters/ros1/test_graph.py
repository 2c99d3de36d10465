from roslens.live.adapters.ros1.graph import build_graph, changes
from roslens.live.adapters.ros1.master import SystemState
from roslens.model.graph import Change, Endpoint, Node, Role

A, B = Node("/a", "vm", 1, ("api",)), Node("/b", "vm", 2, ("api",))
STATE = SystemState(publishers=(("/t", "/a"),), subscribers=(("/t", "/b"),), services=(("/s", "/b"),))
TYPES = {"/t": "std_msgs/String"}


def graph(state=STATE, types=TYPES, nodes=(A, B)):
    return build_graph(state, types, {node.name: node for node in nodes})


def said(before, after, reasons=None):
    return [(event.change, event.entity, event.detail) for event in changes(before, after, 5.0, reasons or {})]


def test_the_graph():
    found = graph()
    assert found.generation == "ros1"
    assert found.nodes == (A, B)
    assert found.hosts == ("vm",)
    assert found.endpoints == (
        Endpoint("/a", Role.PUBLISHER, "/t", "std_msgs/String"),
        Endpoint("/b", Role.SERVICE_SERVER, "/s"),
        Endpoint("/b", Role.SUBSCRIPTION, "/t", "std_msgs/String"),
    )


def test_what_the_dead_are_registered_for_is_not_there():
    found = graph(nodes=(A,))
    assert {end.node for end in found.endpoints} == {"/a"}


def test_nothing_changed():
    assert said(graph(), graph()) == []


def test_a_node_that_vanishes_takes_its_ends_along():
    assert said(graph(), graph(nodes=(A,)), {"/b": "registered, but its API refuses connections"}) == [
        (Change.VANISHED, "node:/b", "registered, but its API refuses connections"),
        (Change.VANISHED, "service:/s", ""),
        (Change.CHANGED, "topic:/t", "no longer subscribed by /b"),
    ]


def test_a_node_that_appears():
    assert said(graph(nodes=(A,)), graph()) == [
        (Change.APPEARED, "node:/b", ""),
        (Change.APPEARED, "service:/s", "served by /b"),
        (Change.CHANGED, "topic:/t", "subscribed by /b"),
    ]


def test_another_process_of_the_same_name_is_a_restart():
    again = Node("/b", "vm", 3, ("api",))
    assert said(graph(), graph(nodes=(A, again))) == [
        (Change.RESTARTED, "node:/b", "process 2 on vm is now 3 on vm"),
    ]


def test_another_type_is_a_change():
    assert said(graph(), graph(types={"/t": "std_msgs/Int32"})) == [
        (Change.CHANGED, "topic:/t", "its type is now std_msgs/Int32"),
    ]
