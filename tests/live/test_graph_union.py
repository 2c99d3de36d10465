from roslens.live.join.graph_union import GraphUnion
from roslens.model.graph import Endpoint, Graph, Node, Process, Role
from roslens.model.qos import Qos


def test_what_several_see_is_joined_and_who_knows_more_wins():
    union = GraphUnion()
    union.put("ros2", Graph("ros2", (Node("/a"), Node("/b", "base", 5)), (Endpoint("/a", Role.PUBLISHER, "/x"),)))
    union.put("base/agent", Graph("", hosts=("base",), processes=(Process("base", 5, "b"),)))
    union.put("ros1", Graph("ros1", (Node("/a", "arm", 7), Node("/c")), parameters={"/c": {"rate": "5"}}))
    assert union.whole() == Graph(
        "ros1+ros2",
        (Node("/a", "arm", 7), Node("/b", "base", 5), Node("/c")),
        (Endpoint("/a", Role.PUBLISHER, "/x"),),
        ("base",),
        (Process("base", 5, "b"),),
        {"/c": {"rate": "5"}},
    )


def test_what_an_observer_says_replaces_what_it_said():
    union = GraphUnion()
    union.put("ros2", Graph("ros2", (Node("/a"),)))
    union.put("ros2", Graph("ros2", (Node("/b"),)))
    assert union.whole().nodes == (Node("/b"),)


def test_endpoints_with_and_without_quality_of_service_are_sorted():
    union = GraphUnion()
    ends = (Endpoint("/a", Role.PUBLISHER, "/x", qos=Qos()), Endpoint("/a", Role.PUBLISHER, "/x"))
    union.put("ros2", Graph("ros2", endpoints=ends))
    assert set(union.whole().endpoints) == set(ends)
    assert GraphUnion().whole() == Graph("")


def test_a_process_is_there_once_with_all_that_is_known_of_it():
    union = GraphUnion()
    union.put("base/ros2", Graph("ros2", processes=(Process("base", 5, "lidar.py --x", 7.0),)))
    union.put("base/monitor", Graph("", processes=(Process("base", 5, nodes=("/lidar",), inner=3),)))
    assert union.whole().processes == (Process("base", 5, "lidar.py --x", 7.0, ("/lidar",), 3),)


def test_what_identifiers_of_hosts_have_is_told():
    union = GraphUnion()
    union.put("a/agent", Graph("", identities={"a": ("aaaa",)}))
    union.put("b/agent", Graph("", identities={"b": ("bbbb", "cccc")}))
    assert union.whole().identities == {"a": ("aaaa",), "b": ("bbbb", "cccc")}
