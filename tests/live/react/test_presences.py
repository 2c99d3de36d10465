"""How the end of a node is known, in whatever order its observers tell of it."""

import itertools

import pytest

from roslens.live.react.presences import Presences
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Change, Event, Graph, Node

CAM, OTHER = Node("/cam", "robot", 7), Node("/other", "robot", 8)
ENTITY = EntityId(EntityKind.NODE, "/cam")


def process_end(time, pid, how):
    return Event(time, Change.VANISHED, f"process:robot/{pid}", "cam", how)


def node_end(time, how=""):
    return Event(time, Change.VANISHED, "node:/cam", "", how)


def orders(time, pid, how):
    """What observers tell of the end of a process, in each order."""
    return itertools.permutations([process_end(time, pid, how), node_end(time, how), Graph("ros2", (OTHER,))])


def take(presences, time, what):
    presences.take_graph(what, time) if isinstance(what, Graph) else presences.happened(what)


@pytest.mark.parametrize("order", list(orders(10.0, 7, "signal 9")))
def test_a_crash_is_known_each_time(order):
    presences = Presences()
    for number, pid in enumerate((7, 17, 27)):
        start = 100.0 * number
        presences.happened(Event(start, Change.RESTARTED if number else Change.APPEARED, "node:/cam"))
        presences.take_graph(Graph("ros2", (Node("/cam", "robot", pid), OTHER)), start)
        for what in order:
            if not isinstance(what, Graph):
                entity = what.entity.replace("/7", f"/{pid}")
                what = Event(start + 10, what.change, entity, what.detail, what.ended)
            take(presences, start + 10, what)
        assert presences.crashed(ENTITY) == start + 10
        assert presences.end_of(ENTITY).how == "signal 9"


def test_a_crash_is_known_though_the_graph_has_lost_the_node_in_a_step_before():
    presences = Presences()
    presences.take_graph(Graph("ros2", (CAM, OTHER)), 0.0)
    presences.happened(node_end(10.0))
    presences.take_graph(Graph("ros2", (OTHER,)), 10.0)
    assert presences.crashed(ENTITY) is None
    presences.happened(process_end(10.1, 7, "signal 11"))
    assert presences.crashed(ENTITY) == 10.1


@pytest.mark.parametrize(
    ("how", "before", "in_order"),
    [
        ("exit 0", True, True),
        ("exit 1", True, False),
        ("signal 2", False, True),
        ("signal 9", True, False),
        ("unknown", True, True),
        ("unknown", False, False),
    ],
)
def test_an_end_in_order_is_told_by_its_status_else_by_the_leave_that_was_taken(how, before, in_order):
    presences = Presences()
    presences.take_graph(Graph("ros2", (CAM, OTHER)), 0.0)
    told = [node_end(10.0), process_end(10.1, 7, how)]
    for one in told if before else reversed(told):
        presences.happened(one)
    assert presences.end_of(ENTITY).in_order is in_order
    assert (presences.crashed(ENTITY) is None) is in_order


def test_the_late_word_of_an_earlier_process_is_not_about_the_one_that_runs():
    presences = Presences()
    presences.take_graph(Graph("ros2", (CAM, OTHER)), 0.0)
    presences.happened(node_end(10.0, "signal 9"))
    presences.happened(Event(12.0, Change.RESTARTED, "node:/cam"))
    presences.happened(process_end(12.1, 7, "signal 9"))
    presences.take_graph(Graph("ros2", (Node("/cam", "robot", 17), OTHER)), 12.5)
    presences.happened(node_end(20.0))
    assert presences.crashed(ENTITY) is None
    presences.happened(process_end(20.1, 17, "exit 0"))
    assert presences.end_of(ENTITY).in_order
