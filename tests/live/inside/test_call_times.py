import pytest

from roslens.live.inside import slots
from roslens.live.inside.call_times import MOST_SERVICES, CallTimes
from roslens.live.inside.counters import Called
from roslens.model.entity import EntityId, EntityKind
from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally

TIMES = Moments(2, 0.3, 0.05, 0.1, 0.2)


def called(kind, count, last=0.0, processing=NOTHING, service="/add"):
    return Called(7, kind, Tally(service, "/n", "", 0.0, 1.0, count, last=last, processing=processing))


def test_calls_a_second_and_times_of_server_and_client():
    calls = CallTimes()
    assert calls.samples(10.0) == []
    calls.add([called(slots.ASKED, 1, 10.0), called(slots.REPLIED, 2, processing=TIMES), called(slots.ASKED, 4, 12.0)])
    calls.add([called(slots.REQUESTED, 1, 10.0), called(slots.REQUESTED, 1, 12.0), called(slots.HEARD, 2, 0.0, TIMES)])
    (sample,) = calls.samples(12.0)
    assert (sample.entity, sample.time, sample.observer) == (
        EntityId(EntityKind.SERVICE, "/add"), 12.0, Observer.INSIDE,
    )  # fmt: skip
    assert sample.values == {
        "calls": 2.0, "client_calls": 0.5,
        "response_time": pytest.approx(0.15), "response_time_max": 0.2,
        "client_response_time": pytest.approx(0.15), "client_response_time_max": 0.2,
    }  # fmt: skip


def rates(times, until, every=0.15):
    """What is said each second of calls at these times that are read every so often."""
    calls, said, read, reported = CallTimes(), [], 0.0, 1.0
    waiting = list(times)
    while read < until:
        read += every
        while waiting and waiting[0] <= read:
            calls.add([called(slots.ASKED, 1, waiting.pop(0))])
        if read >= reported:
            reported += 1.0
            said += [one.values.get("calls") for one in calls.samples(read)] or [None]
    return said


@pytest.mark.parametrize("hertz", [0.2, 0.5, 3.0, 40.0])
def test_a_steady_rate_is_steady_over_its_own_period(hertz):
    said = rates([number / hertz for number in range(1, int(100 * hertz))], 99.0)
    settled = said[int(3 / hertz) + 2 :]
    assert len(settled) > 30
    assert min(settled) == pytest.approx(hertz, rel=0.03)
    assert max(settled) == pytest.approx(hertz, rel=0.03)


def test_calls_twice_in_a_while_do_not_alarm():
    """Every 2 s against at least 0.3 Hz."""
    said = rates([2.0 * number + 0.5 for number in range(20)], 40.0)
    assert all(rate is None or rate >= 0.3 for rate in said)


@pytest.mark.parametrize(("hertz", "most_s"), [(0.5, 12), (10.0, 3)])
def test_a_service_that_nobody_calls_any_more_fades_to_0(hertz, most_s):
    said = rates([number / hertz for number in range(int(20 * hertz))], 60.0)
    assert said[18] == pytest.approx(hertz, rel=0.1)
    fading = [rate for rate in said[20:] if rate]
    assert fading == sorted(fading, reverse=True)
    assert said[20 + most_s :] == [0.0] * len(said[20 + most_s :])


def test_calls_of_several_clients_add_up():
    """Two slots, read at once, each with its own last call."""
    calls = CallTimes()
    for second in range(10):
        calls.add([called(slots.ASKED, 5, second + 0.9), called(slots.ASKED, 5, second + 0.8)])
    assert calls.samples(9.9)[0].values == {"calls": pytest.approx(10.0)}


def test_one_call_has_no_rate_and_a_clock_that_is_set_back_begins_anew():
    calls = CallTimes()
    calls.add([called(slots.ASKED, 2, 1000.0)])
    assert calls.samples(1000.1) == []
    assert calls.samples(1004.0)[0].values == {"calls": 0.25}
    assert calls.samples(10.0) == []
    calls.add([called(slots.ASKED, 1, 11.0)])
    calls.add([called(slots.ASKED, 1, 13.0)])
    assert calls.samples(13.0)[0].values == {"calls": 0.5}


def test_names_without_end_are_not_kept():
    calls = CallTimes()
    for number in range(MOST_SERVICES + 100):
        calls.add([called(slots.ASKED, 1, 1.0, service=f"/s{number}")])
    assert len(calls.samples(3.0)) == MOST_SERVICES
