from roslens.live.join.node_processes import NodeProcesses
from roslens.live.window.newest import MOST_GONE
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph, Node
from roslens.model.traffic.sample import Sample


def graph(*nodes):
    return Graph("ros2", tuple(Node(name, host, pid) for name, host, pid in nodes))


def sample(name, kind=EntityKind.PROCESS, **values):
    return Sample(EntityId(kind, name), 5.0, values)


def reported(samples):
    return [(str(one.entity), one.values) for one in samples]


def test_each_node_of_a_process_gets_its_values():
    join = NodeProcesses()
    join.add_graph("ros2", graph(("/b", "base", 10), ("/a", "base", 10), ("/c", "arm", 10), ("/d", "", 0)))
    assert reported(join.of(sample("base/10", cpu=5.0))) == [
        ("node:/a", {"cpu": 5.0, "restarts": 0.0}),
        ("node:/b", {"cpu": 5.0, "restarts": 0.0}),
    ]
    assert join.of(sample("base/11", cpu=5.0)) == []
    assert join.of(sample("base", EntityKind.HOST, cpu=5.0)) == []
    assert join.process_of("/c") == "arm/10"
    assert join.process_of("/d") == ""


def test_coming_back_elsewhere_is_a_restart():
    join = NodeProcesses()
    for pid in (10, 10, 12, 12, 15):
        join.add_graph("ros2", graph(("/a", "base", pid)))
    assert reported(join.of(sample("base/15"))) == [("node:/a", {"restarts": 2.0})]
    assert join.of(sample("base/10")) == []


def test_two_observers_see_two_parts():
    join = NodeProcesses()
    join.add_graph("ros1", graph(("/a", "base", 10)))
    join.add_graph("ros2", graph(("/b", "base", 11)))
    assert [name for name, _ in reported(join.of(sample("base/10")))] == ["node:/a"]
    assert [name for name, _ in reported(join.of(sample("base/11")))] == ["node:/b"]


def test_what_came_and_went_long_ago_is_forgotten():
    join = NodeProcesses()
    for number in range(MOST_GONE + 10):
        join.add_graph("ros2", graph(("/stays", "base", 1), (f"/tool_{number}", "base", number + 2)))
    assert join.process_of("/stays") == "base/1"
    assert join.process_of("/tool_0") == ""
    assert join.process_of(f"/tool_{MOST_GONE}") == f"base/{MOST_GONE + 2}"
