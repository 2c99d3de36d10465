from roslens.live.adapters.ros2.changes import Changes
from roslens.model.graph import Change, Endpoint, Graph, Node, Role


def graph(**pids):
    nodes = tuple(Node(f"/{name}", "robot", pid) for name, pid in sorted(pids.items()))
    return Graph("ros2", nodes, tuple(Endpoint(node.name, Role.PUBLISHER, f"{node.name}/t") for node in nodes))


def reported(changes, seen, time):
    return [(event.change, event.entity) for event in changes.to(seen, time)]


def test_what_was_there_at_the_beginning_did_not_appear():
    changes = Changes()
    assert reported(changes, graph(a=1), 0) == []
    assert reported(changes, graph(a=1), 1) == []


def test_nodes_and_their_topics_come_and_go():
    changes = Changes()
    changes.to(graph(a=1), 0)
    assert reported(changes, graph(b=2), 1) == [
        (Change.VANISHED, "node:/a"),
        (Change.APPEARED, "node:/b"),
        (Change.VANISHED, "topic:/a/t"),
        (Change.APPEARED, "topic:/b/t"),
    ]


def test_one_that_comes_back_was_started_again_however_fast():
    changes = Changes()
    changes.to(graph(a=1), 0)
    (event,) = changes.to(graph(a=2), 1)
    assert (event.change, event.detail) == (Change.RESTARTED, "process 1 is now 2")
    changes.to(graph(), 100)
    restarted = changes.to(graph(a=3), 103.5)[0]
    assert (restarted.change, restarted.detail) == (Change.RESTARTED, "after 3.5 s; process 3 on robot")


def test_three_starts_in_a_minute_are_flapping():
    changes = Changes()
    seen = [reported(changes, graph(a=pid), pid * 10.0) for pid in range(1, 6)]
    assert [(Change.FLAPPING, "node:/a") in one for one in seen] == [False, False, False, True, True]
    slow = Changes()
    seen = [reported(slow, graph(a=pid), pid * 40.0) for pid in range(1, 6)]
    assert not any((Change.FLAPPING, "node:/a") in one for one in seen)
