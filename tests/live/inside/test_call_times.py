import pytest

from roslens.live.inside import slots
from roslens.live.inside.call_times import CallTimes
from roslens.live.inside.counters import Called
from roslens.model.entity import EntityId, EntityKind
from roslens.model.tally import NOTHING, Moments, Observer, Tally

TIMES = Moments(2, 0.3, 0.05, 0.1, 0.2)


def called(kind, count, processing=NOTHING, service="/add"):
    return Called(7, kind, Tally(service, "/n", "", 0.0, 1.0, count, processing=processing))


def test_calls_a_second_and_times_of_server_and_client():
    calls = CallTimes()
    assert calls.samples(10.0) == []
    calls.add([called(slots.ASKED, 2), called(slots.REPLIED, 2, TIMES), called(slots.ASKED, 2)])
    calls.add([called(slots.REQUESTED, 1), called(slots.HEARD, 2, TIMES)])
    (sample,) = calls.samples(12.0)
    assert (sample.entity, sample.time, sample.observer) == (
        EntityId(EntityKind.SERVICE, "/add"), 12.0, Observer.INSIDE,
    )  # fmt: skip
    assert sample.values == {
        "calls": 2.0, "client_calls": 0.5,
        "response_time": pytest.approx(0.15), "response_time_max": 0.2,
        "client_response_time": pytest.approx(0.15), "client_response_time_max": 0.2,
    }  # fmt: skip


def test_a_service_that_nobody_calls_any_more_is_called_0_times():
    calls = CallTimes()
    calls.samples(0.0)
    calls.add([called(slots.ASKED, 2), called(slots.REPLIED, 2, TIMES)])
    calls.samples(1.0)
    assert [one.values for one in calls.samples(2.0)] == [{"calls": 0.0}]


def test_what_was_counted_before_the_first_sample_has_no_rate():
    calls = CallTimes()
    calls.add([called(slots.ASKED, 2)])
    assert calls.samples(1.0) == []
