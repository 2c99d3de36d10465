from roslens.live.publish.placed import Placed
from roslens.live.system.connection_name import connection_id
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Endpoint, Graph, Node, Role

GRAPH = Graph(
    "ros2",
    (Node("/a", "one"), Node("/b", "two"), Node("/c", "")),
    (
        Endpoint("/a", Role.PUBLISHER, "/scan", "t"),
        Endpoint("/b", Role.SUBSCRIPTION, "/scan", "t"),
        Endpoint("/a", Role.PUBLISHER, "/tf", "t"),
        Endpoint("/b", Role.PUBLISHER, "/tf", "t"),
    ),
)


def test_where_it_is_published_is_where_it_is():
    place = Placed(GRAPH)
    cases = {
        EntityId(EntityKind.NODE, "/a"): "one",
        EntityId(EntityKind.NODE, "/nobody"): "",
        EntityId(EntityKind.TOPIC, "/scan"): "one",
        EntityId(EntityKind.TOPIC, "/tf"): "one, two",
        EntityId(EntityKind.TOPIC, "/none"): "",
        connection_id("/scan", "/a", "/b"): "one",
        connection_id("/scan", "", "/b"): "",
        EntityId(EntityKind.HOST, "two"): "two",
        EntityId(EntityKind.PROCESS, "two/7"): "two",
        EntityId(EntityKind.SERVICE, "/s"): "",
    }
    assert {entity: place.host_of(entity) for entity in cases} == cases
