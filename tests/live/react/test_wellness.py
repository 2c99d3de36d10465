"""A monitor is fit to decide once it knows who is there: the end of what it never saw is noticed by nobody."""

from __future__ import annotations

from roslens.live.join.session import Step
from roslens.live.react.wellness import BEGINNING_S, GROWING_S, LONGEST_GROWING_S, Wellness
from roslens.model.graph import Graph, Node

PERIOD_S = 0.1


def graph(*names: str) -> Graph:
    return Graph("ros2", tuple(Node(name, "robot", number + 1) for number, name in enumerate(names)))


def fit_at(graphs: dict[float, Graph], seeing_at: float = 0.0) -> float:
    """Return when it is first fit, where observers see from then on and graphs come at these times."""
    wellness = Wellness(0.0)
    for number in range(1, 1000):
        now = round(number * PERIOD_S, 1)
        if not wellness.look(Step(now, graph=graphs.get(now), begun=now >= seeing_at), now):
            return now
    return float("inf")


def test_the_first_seconds_count_from_when_observers_see():
    assert fit_at({4.0: graph("/a")}, seeing_at=4.0) - 4.0 >= BEGINNING_S - 2 * PERIOD_S


def test_a_node_that_is_found_late_is_waited_for():
    assert fit_at({0.5: graph(), 4.0: graph("/a"), 6.5: graph("/a", "/b")}) == 6.5 + GROWING_S


def test_a_node_whose_process_is_found_late_is_waited_for():
    unplaced = Graph("ros2", (Node("/a"),))
    assert fit_at({0.5: unplaced, 4.0: graph("/a")}) == 4.0 + GROWING_S


def test_nodes_that_leave_are_not_waited_for():
    assert fit_at({0.5: graph("/a", "/b"), 4.5: graph("/a")}) == BEGINNING_S


def test_a_graph_that_grows_for_ever_is_not_waited_for():
    growing = {float(second): graph(*(f"/n{number}" for number in range(second))) for second in range(1, 90)}
    assert fit_at(growing) == LONGEST_GROWING_S


def test_once_fit_new_nodes_are_no_reason_to_wait():
    wellness = Wellness(0.0)
    for number in range(1, 61):
        wellness.look(Step(number * PERIOD_S), number * PERIOD_S)
    assert wellness.look(Step(6.1, graph=graph("/new")), 6.1) == ""
