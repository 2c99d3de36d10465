import pytest

from roslens.live.join.service_calls import EVERY_S, STALE_S, ServiceCalls
from roslens.model.entity import EntityId, EntityKind
from roslens.model.traffic.sample import Sample

ADD = EntityId(EntityKind.SERVICE, "/add")


def sample(time=0.0, **values):
    return Sample(ADD, time, values)


def test_hosts_are_joined_on_the_clock_of_the_monitor():
    calls = ServiceCalls()
    calls.put("a", sample(9e9, calls=3.0, response_time=0.1, response_time_max=0.2), 1.0)
    calls.put("b", sample(1.0, calls=1.0, response_time=0.5, response_time_max=0.6, client_calls=4.0), 1.0)
    (one,) = calls.samples(1.5)
    assert one.time == 1.5
    assert one.values == {
        "calls": 4.0, "client_calls": 4.0, "response_time": pytest.approx(0.2), "response_time_max": 0.6,
    }  # fmt: skip


def test_a_service_is_told_once_a_second_and_where_there_is_news():
    calls = ServiceCalls()
    calls.put("a", sample(calls=1.0), 1.0)
    assert len(calls.samples(1.0)) == 1
    assert calls.samples(1.0 + EVERY_S) == []
    calls.put("a", sample(calls=1.0), 1.1)
    assert calls.samples(1.1) == []
    assert len(calls.samples(1.0 + EVERY_S)) == 1


def test_a_host_that_fell_silent_counts_no_more():
    calls = ServiceCalls()
    calls.put("a", sample(calls=1.0), 0.0)
    calls.put("b", sample(calls=2.0), STALE_S + 1)
    assert [one.values for one in calls.samples(STALE_S + 1)] == [{"calls": 2.0}]


def test_a_time_without_a_longest_is_taken_as_it_is():
    calls = ServiceCalls()
    calls.put("a", sample(response_time=0.1), 0.0)
    calls.put("b", sample(client_response_time_max=0.2), 0.0)
    assert [one.values for one in calls.samples(0.0)] == [{"response_time": 0.1, "client_response_time_max": 0.2}]
