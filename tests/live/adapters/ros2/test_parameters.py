from types import SimpleNamespace

import pytest

from roslens.live.adapters.ros2.parameters import (
    AGAIN_S,
    AT_ONCE,
    EVENTS,
    MOST,
    PACE_S,
    PATIENCE_S,
    REREAD_PACE_S,
    REREAD_S,
    TRIES,
    Parameters,
    lives,
    value_of,
)
from roslens.model.graph import Change, Endpoint, Event, Graph, Role

LIST, GET = "rcl_interfaces/srv/ListParameters", "rcl_interfaces/srv/GetParameters"


def graph(*names, life="a", topic=EVENTS):
    return Graph(
        "ros2",
        endpoints=tuple(
            end
            for name in names
            for end in (
                Endpoint(name, Role.SERVICE_SERVER, f"{name}/list_parameters", LIST),
                Endpoint(name, Role.SERVICE_SERVER, f"{name}/get_parameters", GET),
                Endpoint(name, Role.PUBLISHER, topic, gid=life * 32),
            )
        ),
    )


def silent(*names):
    """Return nodes that do not publish changes of their parameters."""
    return graph(*names, topic="/rosout")


class Asked:
    def __init__(self, name):
        self.name, self.answer, self.closed = name, None, False

    def step(self):
        return self.answer

    def close(self):
        self.closed = True


@pytest.fixture
def asked():
    return []


@pytest.fixture
def parameters(asked):
    return Parameters(lambda name: asked.append(Asked(name)) or asked[-1])


def turn_until_idle(parameters, asked, now=0.0):
    for one in asked:
        one.answer = {"rate": "10"} if one.answer is None else one.answer
    parameters.turn(now)


def test_only_nodes_that_offer_both_services_are_asked():
    other = Endpoint("/b", Role.SERVICE_SERVER, "/b/list_parameters", LIST)
    foreign = Endpoint("/c", Role.SERVICE_SERVER, "/d/get_parameters", GET)
    retyped = Endpoint("/c", Role.SERVICE_SERVER, "/c/get_parameters", "a/srv/Other")
    ends = (*graph("/a").endpoints, other, foreign, retyped)
    assert lives(Graph("ros2", endpoints=ends)) == {"/a": frozenset(["a" * 24])}


def test_what_a_node_answers_is_known_and_no_event(parameters, asked):
    parameters.follow(graph("/a"))
    assert parameters.busy
    parameters.turn(0.0)
    assert parameters.known() == {}
    asked[0].answer = {"rate": "10"}
    parameters.turn(0.1)
    assert parameters.news
    assert parameters.known() == {"/a": {"rate": "10"}}
    assert (parameters.busy, parameters.news, asked[0].closed, parameters.events(9.0)) == (False, False, True, [])


def test_few_are_asked_at_a_time_and_new_ones_at_a_pace(parameters, asked):
    parameters.follow(graph(*(f"/n{number:03}" for number in range(200))))
    now, most = 0.0, 0
    while parameters.busy:
        parameters.turn(now)
        most = max(most, sum(not one.closed for one in asked))
        now += 0.02
        for one in asked:
            one.answer = {}
    assert most <= AT_ONCE
    assert 200 * PACE_S <= now < 200 * PACE_S * 1.5
    assert len(parameters.known()) == 200


def test_a_node_that_does_not_answer_is_let_go_and_asked_again_later(parameters, asked):
    parameters.follow(graph("/a"))
    now = 0.0
    for tries in range(1, TRIES + 2):
        parameters.turn(now)
        parameters.turn(now + PATIENCE_S)
        assert not parameters.busy
        assert len(asked) == min(tries, TRIES)
        now += PATIENCE_S + AGAIN_S
        parameters.again(now - 1)
        assert not parameters.busy
        parameters.again(now)
    assert all(one.closed for one in asked)
    assert parameters.known() == {}


def test_a_change_is_an_event(parameters, asked):
    parameters.follow(graph("/a"))
    parameters.turn(0.0)
    asked[0].answer = {"rate": "10", "old": "x"}
    parameters.turn(0.1)
    parameters.known()
    parameters.note("/a", {"rate": "20", "new": "y"}, ["old", "other"], 7.0)
    parameters.note("/unknown", {"rate": "20"}, [], 7.0)
    assert parameters.events(9.0) == [
        Event(7.0, Change.APPEARED, "parameter:/a/new", "is y"),
        Event(7.0, Change.VANISHED, "parameter:/a/old", "was x"),
        Event(7.0, Change.CHANGED, "parameter:/a/rate", "10 is now 20"),
    ]
    assert parameters.news
    assert parameters.known() == {"/a": {"rate": "20", "new": "y"}}
    parameters.note("/a", {"rate": "20"}, [], 8.0)
    assert (parameters.events(9.0), parameters.news) == ([], False)


def test_a_change_while_it_is_asked_makes_it_be_asked_again(parameters, asked):
    parameters.follow(graph("/a"))
    parameters.turn(0.0)
    parameters.note("/a", {"rate": "20"}, [], 7.0)
    asked[0].answer = {"rate": "10"}
    parameters.turn(0.1)
    assert parameters.known() == {}
    asked[1].answer = {"rate": "20"}
    parameters.turn(0.2)
    assert parameters.known() == {"/a": {"rate": "20"}}


def asked_again(parameters, now):
    """Go on as an observer does, until one that tells no changes is asked, or none is."""
    parameters.again(now)
    parameters.again(now + REREAD_S - 0.1)
    assert not parameters.busy
    parameters.again(now + REREAD_S)
    parameters.turn(now + REREAD_S)
    return parameters.busy


def test_one_that_tells_no_changes_is_asked_again_and_that_is_told_once(parameters, asked):
    parameters.follow(silent("/a"))
    parameters.turn(0.0)
    asked[0].answer = {"rate": "10"}
    parameters.turn(0.1)
    parameters.known()
    assert parameters.failures() == []
    for turn, (rate, change) in enumerate([("20", ["10 is now 20"]), ("20", []), ("30", ["20 is now 30"])]):
        now = 1.0 + 20 * turn
        assert asked_again(parameters, now)
        told = [one.what for one in parameters.failures()]
        expected = ["/a does not publish /parameter_events: changes of its parameters are noticed some seconds late"]
        assert told == (expected if turn == 0 else [])
        asked[-1].answer = {"rate": rate}
        parameters.turn(now + REREAD_S)
        assert [(one.time, one.detail) for one in parameters.events(70.0)] == [(70.0, text) for text in change]
        assert parameters.news is bool(change)
        assert parameters.known() == {"/a": {"rate": rate}}


def test_one_that_tells_changes_is_not_asked_again(parameters, asked):
    parameters.follow(graph("/a"))
    parameters.turn(0.0)
    asked[0].answer = {"rate": "10"}
    parameters.turn(0.1)
    assert not asked_again(parameters, 1.0)
    # Its publisher was seen later than its services.
    parameters.follow(silent("/b"))
    parameters.turn(20.0)
    asked[-1].answer = {"rate": "10"}
    parameters.turn(20.1)
    parameters.again(20.2)
    parameters.follow(graph("/b"))
    assert not asked_again(parameters, 21.0)
    assert parameters.failures() == []


def test_of_many_that_tell_no_changes_each_has_its_turn(parameters, asked):
    names = [f"/n{number:02}" for number in range(30)]
    parameters.follow(silent(*names))
    now, seen = 0.0, []
    while now < 100:
        parameters.again(now)
        parameters.turn(now)
        seen += [(now, one.name) for one in asked if not one.closed and one.answer is None]
        for one in asked:
            one.answer = {}
        now += 0.25
    later = [name for time, name in seen if time > 20]
    assert len(later) <= 80 / REREAD_PACE_S
    assert {later.count(name) for name in names} == {2, 3}


def test_values_of_one_that_neither_tells_nor_answers_are_not_known_any_more(parameters, asked):
    parameters.follow(silent("/a"))
    parameters.turn(0.0)
    asked[0].answer = {"rate": "10"}
    parameters.turn(0.1)
    now = 1.0
    for _ in range(TRIES):
        assert parameters.known() == {"/a": {"rate": "10"}}
        parameters.again(now)
        now += PATIENCE_S + AGAIN_S
        parameters.again(now)
        parameters.turn(now)
        parameters.turn(now + PATIENCE_S)
    assert parameters.news
    assert parameters.known() == {}
    now += PATIENCE_S + AGAIN_S
    parameters.again(now)
    parameters.turn(now)
    asked[-1].answer = {"rate": "20"}
    parameters.turn(now)
    assert parameters.known() == {"/a": {"rate": "20"}}


def test_one_that_went_is_forgotten_and_one_that_came_back_is_asked_anew(parameters, asked):
    parameters.follow(graph("/a"))
    parameters.turn(0.0)
    parameters.follow(graph())
    assert asked[0].closed
    parameters.follow(graph("/a"))
    parameters.turn(1.0)
    asked[1].answer = {"rate": "10"}
    parameters.turn(1.1)
    parameters.follow(graph("/a", life="b"))
    assert parameters.known() == {}
    parameters.turn(2.0)
    assert len(asked) == 3
    parameters.close()
    assert asked[2].closed


def test_a_node_with_endless_parameters_is_bounded(parameters, asked):
    parameters.follow(graph("/a"))
    parameters.turn(0.0)
    asked[0].answer = {}
    parameters.turn(0.1)
    parameters.note("/a", {f"p{number}": "1" for number in range(MOST + 1)}, [], 1.0)
    assert parameters.known() == {"/a": {}}


@pytest.mark.parametrize(
    ("kind", "field", "value", "found"),
    [
        (0, "bool_value", True, None),
        (1, "bool_value", True, True),
        (2, "integer_value", 3, 3),
        (3, "double_value", 0.5, 0.5),
        (4, "string_value", "x", "x"),
        (5, "byte_array_value", [b"\1", b"\2"], b"\1\2"),
        (9, "string_array_value", ("x", "y"), ["x", "y"]),
        (99, "string_value", "x", None),
    ],
)
def test_values_of_every_type(kind, field, value, found):
    assert value_of(SimpleNamespace(type=kind, **{field: value})) == found
