from roslens.compare.interface_users import recorded_uses, using_nodes
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode, Proof
from roslens.model.graph import Endpoint, Graph, Role

_PLACE = Proof("a.cpp", 3)


def test_nodes_are_found_by_the_full_type_of_both_generations():
    ends = (
        ConfiguredEndpoint(Endpoint("/a", Role.PUBLISHER, "/x", "pkg/msg/A"), _PLACE),
        ConfiguredEndpoint(Endpoint("/a", Role.SERVICE_CLIENT, "/s", "pkg/A"), _PLACE),
        ConfiguredEndpoint(Endpoint("/a", Role.SUBSCRIPTION, "/y", "pkg/msg/B"), _PLACE),
    )
    graph = Configuration("t", "ros2", (ConfiguredNode("/a", _PLACE, endpoints=ends),))
    found = using_nodes((graph, graph), {"pkg/msg/A", "pkg/srv/A"})
    assert [(one.how, one.interface, one.place) for one in found] == [
        ("calls /s", "pkg/srv/A", "a.cpp:3"),
        ("publishes /x", "pkg/msg/A", "a.cpp:3"),
    ]


def test_a_recording_of_the_type_of_now_is_not_affected():
    def topic(name, of):
        return Endpoint("/a", Role.PUBLISHER, name, "pkg/msg/A", of)

    graph = Graph("ros2", endpoints=(topic("/now", "new"), topic("/was", "old"), topic("/unknown", "")))
    found = list(recorded_uses("a.mcap", graph, {"pkg/msg/A": ("old", "new")}))
    assert [one.how for one in found] == ["holds /was", "holds /unknown (which type it recorded is unknown)"]
