from roslens.live.adapters.ros2.changes import Changes
from roslens.live.adapters.ros2.lifecycle import TYPE, Lifecycles, managed
from roslens.model.graph import Change, Endpoint, Graph, Node, Role


def offer(node, kind=TYPE, name=None):
    return Endpoint(node, Role.SERVICE_SERVER, name or f"{node}/get_state", kind)


def test_managed_nodes_are_those_that_tell_their_state():
    ends = [offer("/a"), offer("/b", kind="a/srv/Other"), offer("/c", name="/d/get_state")]
    assert managed(ends) == {"/a": "/a/get_state"}


class FakeClient:
    def __init__(self, service):
        self.service, self.answers, self.asked, self.closed = service, [], 0, False

    def ask(self):
        self.asked += 1

    def answer(self):
        return self.answers.pop() if self.answers else ""

    def close(self):
        self.closed = True


def test_a_state_holds_until_another_is_told_and_goes_with_the_node():
    made = []
    lifecycles = Lifecycles(lambda service: made.append(FakeClient(service)) or made[-1])
    lifecycles.follow([offer("/a")])
    assert not lifecycles.turn()
    assert (made[0].service, made[0].asked, lifecycles.state("/a")) == ("/a/get_state", 1, "")
    made[0].answers = ["active"]
    assert lifecycles.turn()
    assert not lifecycles.turn()
    assert lifecycles.state("/a") == "active"
    lifecycles.follow([])
    assert made[0].closed
    assert lifecycles.state("/a") == ""


def test_a_transition_is_an_event():
    changes = Changes()
    for state in ("", "inactive"):
        assert changes.to(Graph("ros2", (Node("/a", lifecycle=state),)), 0) == []
    (event,) = changes.to(Graph("ros2", (Node("/a", lifecycle="active"),)), 1)
    assert (event.change, event.entity, event.detail) == (Change.CHANGED, "node:/a", "inactive is now active")
