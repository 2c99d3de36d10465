import msgspec

from roslens.live.publish.graph_json import graph_bytes
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.qos import Qos


def test_a_graph_is_read_back_as_it_was():
    end = Endpoint("/lidar", Role.PUBLISHER, "/scan", "a/B", qos=Qos("reliable"))
    graph = Graph("ros2", (Node("/lidar", "host", 7),), (end,), parameters={"/lidar": {"rate": "1"}})
    assert msgspec.json.decode(graph_bytes(graph), type=Graph) == graph


def test_a_name_that_cannot_be_encoded_is_replaced():
    found = msgspec.json.decode(graph_bytes(Graph("ros1", (Node("/li\ud800dar"),))), type=Graph)
    assert found.nodes == (Node("/li?dar"),)
