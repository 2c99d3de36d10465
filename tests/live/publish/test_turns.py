from itertools import pairwise

import pytest

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import Details, Expectation, Reference, Selector
from roslens.live.publish.diagnostics import ERROR, OK
from roslens.live.publish.turns import MOST_AT_ONCE, Turns
from roslens.live.system.connection_name import connection_id
from roslens.model.acting.outgoing import Status
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Graph, Node
from roslens.model.verdict import State, Verdict
from roslens.store.journals.journal_head import JournalHead

A, B = (EntityId(EntityKind.NODE, name) for name in ("/a", "/b"))


def verdict(entity, state=State.OK, expectation="r.cpu"):
    return Verdict(entity, expectation, "cpu", state, 1.0, 2.0, 50.0)


class Watched:
    def __init__(self, *verdicts):
        self.verdicts = list(verdicts)
        self.looks = 0

    def standing(self):
        self.looks += 1
        return self.verdicts

    def graph(self):
        return Graph("ros2", (Node("/a", "base"),))

    def readings(self, now):
        return [(connection_id("/t", "/a", "/b"), {"rate": now})]


def turns(watched, reference=None, **chosen):
    return Turns(watched, reference or (lambda: Reference("r")), "m", **{"diagnostics": True, "rated": False, **chosen})


def names(frames):
    return [status.name for frame in frames for status in frame.statuses]


def test_everything_each_second_and_nothing_in_between():
    one = turns(Watched(verdict(A), verdict(B)))
    (frame,) = one.take((), 100.0)
    assert (frame.time, names([frame])) == (100.0, ["roslens: node /a", "roslens: node /b"])
    assert [status.hardware_id for status in frame.statuses] == ["base", ""]
    times = [now / 10 for now in range(1001, 1100) if one.take((), now / 10)]
    gaps = [after - before for before, after in pairwise(times)]
    assert all(gap == pytest.approx(1.0, abs=0.11) for gap in gaps[1:])
    assert 9 <= len(times) <= 11


def test_what_changed_is_told_at_once_with_all_that_stands_of_the_entity():
    watched = Watched(verdict(A), verdict(A, expectation="r.memory"), verdict(B))
    one = turns(watched)
    one.take((), 100.0)
    watched.verdicts[0] = verdict(A, State.HIGH)
    (frame,) = one.take([watched.verdicts[0]], 100.2)
    assert names([frame]) == ["roslens: node /a"]
    assert (frame.statuses[0].level, len(frame.statuses[0].values)) == (1, 4)


def test_a_storm_of_changes_is_gathered():
    watched = Watched(verdict(A), verdict(B))
    one = turns(watched)
    one.take((), 100.0)
    frames = [one.take([verdict(A if step % 2 else B)], 100.1 + step / 1000) for step in range(200)]
    reported = [frame for frame in frames if frame]
    assert len(reported) == 2
    assert names(reported[1]) == ["roslens: node /a", "roslens: node /b"]


def test_of_an_entity_that_is_no_more_nothing_is_said_and_nobody_looks_again():
    watched = Watched(verdict(B))
    one = turns(watched)
    one.take((), 100.0)
    looks = watched.looks
    assert one.take([verdict(A)], 100.2) == []
    assert one.take((), 100.4) == []
    assert watched.looks == looks + 1


def test_a_clock_that_was_set_back_silences_nobody():
    one = turns(Watched(verdict(A)))
    one.take((), 100.0)
    assert one.take((), 50.0)
    assert one.take([verdict(A)], 50.3)


def test_more_than_fits_is_told_in_several_messages():
    entities = [EntityId(EntityKind.NODE, f"/{number:05}") for number in range(2 * MOST_AT_ONCE + 1)]
    one = turns(Watched(*(verdict(entity) for entity in entities)), rated=True)
    frames = one.take((), 100.0)
    assert [len(frame.statuses) for frame in frames[:3]] == [MOST_AT_ONCE, MOST_AT_ONCE, 1]
    rated = [frame.rated for frame in frames[3:]]
    assert [(one.part, one.parts, one.complete, len(one.signals)) for one in rated] == [
        (0, 3, True, MOST_AT_ONCE), (1, 3, True, MOST_AT_ONCE), (2, 3, True, 1),
    ]  # fmt: skip
    assert [len(one.connections) for one in rated] == [1, 0, 0]


def test_bounds_are_those_of_the_reference_that_holds_now():
    def held(high):
        details = Details("r.cpu")
        return Reference("r", expectations=(Expectation(details, Selector(EntityKind.NODE), "cpu", Range(0, high)),))

    holds = [held(80.0)]
    one = turns(Watched(verdict(A)), lambda: holds[-1], diagnostics=False, rated=True)
    assert one.take((), 100.0)[0].rated.signals[0].high == 80.0
    holds.append(held(90.0))
    (frame,) = one.take([verdict(A)], 100.2)
    assert (frame.statuses, frame.rated.complete, frame.rated.connections) == (None, False, ())
    assert frame.rated.signals[0].high == 90.0


def test_journals_are_told_of_each_second_with_where_they_end():
    heads = [JournalHead("/j", 12, "3f09"), JournalHead("/k", 3, "77aa", "the end was cut off")]
    watched = Watched(verdict(A))
    one = turns(watched, journals=lambda: heads)
    (frame,) = one.take((), 100.0)
    assert frame.statuses[1:] == (
        Status(OK, "roslens: journal /j", "ends as it was written", "m", (("entries", "12"), ("head", "3f09"))),
        Status(ERROR, "roslens: journal /k", "the end was cut off", "m", (("entries", "3"), ("head", "77aa"))),
    )
    assert names(one.take([verdict(A, State.HIGH)], 100.2)) == ["roslens: node /a"]
