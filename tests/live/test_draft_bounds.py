"""Bounds that are drafted of what was measured once a second."""

from __future__ import annotations

import msgspec
import pytest

from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.drafting.draft_bounds import SETTLING_S, Bound, Values, means
from roslens.live.drafting.draft_session import DraftSession
from roslens.live.drafting.draft_states import Kept, States
from roslens.live.drafting.draft_text import Beside, draft_text
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Endpoint, Graph, Node, Role
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import Moments, Tally
from roslens.model.wire import VERSION, Frame

SCAN = EntityId(EntityKind.TOPIC, "/scan")
LIDAR = EntityId(EntityKind.NODE, "/lidar")
HOST = EntityId(EntityKind.HOST, "robot")


def drafted(entity: EntityId, key: str, values: list[float]) -> Bound | None:
    """Return the bound that these values, one a second after settling, give."""
    found = Values(1.0)
    found.look(0.0, [(entity, {key: 1e9})])
    for number, value in enumerate(values):
        found.look(SETTLING_S + number, [(entity, {key: value})])
    return next(iter(found.drafted()), None)


def read_back(*bounds: Bound, kept: tuple[Kept, ...] = ()) -> tuple[str, list[tuple[str, str]]]:
    """Return the document with these bounds, and the names and signals that it has constraints on."""
    text = draft_text("mine", (), (), "a watch", Beside(bounds=bounds, kept=kept))
    reference = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY)
    return text, [(one.selector.name, one.quantity) for one in reference.expectations]


@pytest.mark.parametrize(
    ("entity", "key", "value", "bound"),
    [
        (SCAN, "age", 0.004, 0.024),
        (SCAN, "latency", 0.1, 0.2),
        (SCAN, "loss", 0.0, 10.0),
        (SCAN, "loss", 40.0, 60.0),
        (LIDAR, "cpu", 10.0, 30.0),
        (LIDAR, "memory", 200e6, 250e6),
        (HOST, "memory_share", 20.0, 30.0),
        (EntityId(EntityKind.SERVICE, "/get"), "response_time", 0.01, 0.06),
    ],
)
def test_a_bound_is_what_was_measured_and_room(entity, key, value, bound):
    found = drafted(entity, key, [value] * 60)
    assert (found.range.minimum, found.range.maximum) == (None, pytest.approx(bound))
    assert (found.typical, found.outside, found.unsteady) == (pytest.approx(value), 0, "")
    assert found.hours == pytest.approx(60 / 3600)


def test_what_comes_once_is_no_part_of_the_bound():
    found = drafted(SCAN, "age", [0.004] * 30 + [2.0] + [0.004] * 30)
    assert found.range.maximum > 0.4
    # One value of five that are judged together lifts all five means: they are one time outside.
    calm = drafted(SCAN, "age", [0.004] * 61)
    assert calm.range.maximum == pytest.approx(0.024)


def test_what_grows_is_proposed_but_not_steady():
    found = drafted(LIDAR, "memory", [100e6 + 2e6 * number for number in range(120)])
    assert "left in the second" in found.unsteady
    text, constraints = read_back(found)
    assert constraints == []
    assert "#   memory: <= " in text


def test_few_values_are_not_steady():
    found = drafted(SCAN, "age", [0.004] * 9)
    assert found.unsteady == "9 values are too few"


@pytest.mark.parametrize("key", ["age", "loss"])
def test_of_what_is_beyond_meaning_nothing_is_proposed(key):
    assert drafted(SCAN, key, [1e8] * 60) is None


def test_publishers_and_misfits_are_exact_where_they_stayed():
    same = drafted(SCAN, "publishers", [2.0] * 60)
    assert (same.range, same.unsteady) == (Range(2.0, 2.0), "")
    other = drafted(SCAN, "publishers", [1.0] * 40 + [2.0] * 20)
    assert other.unsteady == "from 1 to 2, changed 1 time"
    assert drafted(SCAN, "publishers", [0.0] * 60) is None
    known = drafted(SCAN, "misfits", [1.0] * 60)
    assert known.range == Range(maximum=1.0)
    text, constraints = read_back(same, drafted(SCAN, "misfits", [0.0] * 60))
    assert "    publishers: 2  # typically 2; outside 0 times in 60 s: at most 180 alarms an hour" in text
    assert "    misfits: 0  # " in text
    assert constraints == [("/scan", "misfits"), ("/scan", "publishers")]


def test_what_settles_is_not_measured():
    found = Values(1.0)
    for second in range(5):
        found.look(float(second), [(LIDAR, {"cpu": 90.0})])
    assert found.drafted() == ()


@pytest.mark.parametrize("name", ["/lidar/get_parameters", "/nav/_action/send_goal", "/lidar/get_loggers"])
def test_services_that_many_nodes_have_are_left_out(name):
    assert drafted(EntityId(EntityKind.SERVICE, name), "response_time", [0.01] * 60) is None


def test_means_of_what_is_judged_together():
    assert means([1.0, 2.0]) == [1.5]
    assert means([0.0, 0.0, 0.0, 0.0, 5.0, 5.0]) == [1.0, 2.0]


def graph(state: str, gain: str) -> Graph:
    values = {"gain": gain, "password": "***", "qos_overrides./scan.depth": "5", "range": "1..2", "on": "true"}
    return Graph("ros2", (Node("/lidar", lifecycle=state),), parameters={"/lidar": values})


def test_states_and_parameters_that_stayed_are_required():
    states = States()
    for second in range(60):
        states.look(graph("active", "2" if second < 30 else "3"))
    kept = states.drafted(60.0)
    assert [(one.entity.name, one.value, one.changes) for one in kept] == [
        ("/lidar", "active", 0),
        ("/lidar/gain", "3", 1),
        ("/lidar/on", "true", 0),
    ]
    text = draft_text("mine", (), (), "a watch", Beside(kept=kept))
    reference = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY)
    assert [(one.selector.name, one.allowed) for one in reference.states] == [
        ("/lidar", ("active",)),
        ("/lidar/on", ("true",)),
    ]
    assert "  #   value: 3  # not steady: at 60 looks, changed 1 time: about 60 alarms an hour" in text


def test_a_state_that_is_not_reported_any_more_is_left_out():
    states = States()
    states.look(graph("active", "2"))
    states.look(Graph("ros2", (Node("/other"),)))
    assert states.drafted(2.0) == ()


@pytest.mark.parametrize("value", ["a: b", "#1", "no", 'with "quotes"', "[1, 2]", "-3.5", "é\\n", "*"])
def test_texts_of_parameters_are_read_back_as_they_are(value):
    entity = EntityId(EntityKind.PARAMETER, "/lidar/text")
    text = draft_text("mine", (), (), "a watch", Beside(kept=(Kept(entity, value, 60, 0, 1 / 60),)))
    (check,) = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY).states
    assert check.allowed == (value,)


def test_a_session_measures_and_its_draft_holds():
    session = DraftSession(start=100.0)
    ends = (
        Endpoint("/lidar", Role.PUBLISHER, "/scan", "t/T"),
        Endpoint("/map", Role.SUBSCRIPTION, "/scan", "t/T"),
        Endpoint("/map", Role.SERVICE_SERVER, "/get_map", "s/S"),
    )
    whole = Graph("ros2", (Node("/lidar", lifecycle="active"), Node("/map")), ends, parameters={"/map": {"size": "4"}})

    def second(now: float, **changed: object) -> list[Frame]:
        period = Moments(10, 1.0, 0.1, 0.1, 0.1)
        late = Moments(10, 0.05, 0.00025, 0.005, 0.005)
        sent = Tally("/scan", "/lidar", "", now, now + 1.0, 10, period=period)
        taken = Tally("/scan", "/lidar", "/map", now, now + 1.0, 10, period=period, latency=late, lost=0)
        load = Sample(LIDAR, now + 1.0, {"cpu": 5.0, "memory": 80e6})
        found = Frame(VERSION, "ros2", 0, now + 1.0, [sent, taken], [load], graph=whole)
        return [msgspec.structs.replace(found, **changed)]

    for now in range(100, 160):
        session.take(second(float(now)))
        session.look(now + 1.0)
    kept = session.states.drafted(session.looked)
    beside = Beside(session.attendance.drafted(session.looked), session.values.drafted(), kept)
    text = draft_text("mine", session.observed.drafted(), (), "a script", beside)
    reference = load_reference([GivenText("draft.yaml", text.encode())], BY_KEY)
    assert {one.quantity for one in reference.expectations} == {
        "rate", "largest_gap", "latency", "loss", "publishers", "misfits", "cpu", "memory",
    }  # fmt: skip
    assert {one.selector.name for one in reference.presences} == {"/lidar", "/map", "/get_map"}
    assert {one.selector.name for one in reference.states} == {"/lidar", "/map/size"}
    assert text.count("- topic: /scan\n") == 1
