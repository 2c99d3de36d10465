from types import SimpleNamespace

import pytest

from roslens.live.adapters.ros2.topic_statistics import TopicStatistics, moments_of
from roslens.live.window.plausible_tally import plausible_tally
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.traffic.tally import NOTHING, Observer

NAN = float("nan")


def points(*values):
    return [SimpleNamespace(data_type=kind, data=value) for kind, value in enumerate(values, 1)]


def message(
    source="message_period", values=(100.0, 90.0, 120.0, 10.0, 9.0), unit="ms", start=1000, stop=1001, name="n"
):
    return SimpleNamespace(
        measurement_source_name=name,
        metrics_source=source,
        unit=unit,
        window_start=SimpleNamespace(sec=start, nanosec=0),
        window_stop=SimpleNamespace(sec=stop, nanosec=500_000_000),
        statistics=points(*values),
    )


def graph(*subscribed, publishers=("/p",)):
    ends = [Endpoint("/ns/n", Role.SUBSCRIPTION, name) for name in (*subscribed, "/parameter_events", "/clock")]
    return Graph("ros2", (), (*ends, *(Endpoint(node, Role.PUBLISHER, "/scan") for node in publishers)))


@pytest.fixture
def statistics():
    made = TopicStatistics("vm")
    made.choose(graph("/scan"))
    return made


def test_period_and_age_of_a_window_are_one_tally(statistics):
    assert statistics.take(message("message_age", (20.0, 10.0, 30.0, 5.0, 10.0)), "g", "/ns/n", 2000.0) is None
    tally = statistics.take(message(), "g", "/ns/n", 2000.0)
    assert (tally.topic, tally.publisher, tally.subscriber) == ("/scan", "/p", "/ns/n")
    assert (tally.start, tally.end, tally.count) == (1998.5, 2000.0, 10)
    assert tally.period.mean == pytest.approx(0.1)
    assert tally.period.deviation == pytest.approx(0.01)
    assert (tally.period.least, tally.period.greatest) == (pytest.approx(0.09), pytest.approx(0.12))
    assert tally.age.mean == pytest.approx(0.02)
    assert (tally.observer, tally.bytes, tally.lost, tally.host) == (Observer.PROTOCOL, -1, -1, "vm")
    assert plausible_tally(tally) == tally
    assert statistics.failures() == []


def test_without_header_the_age_is_unknown(statistics):
    statistics.take(message("message_age", (NAN, NAN, NAN, NAN, 0.0)), "g", "/ns/n", 2000.0)
    assert statistics.take(message(), "g", "/ns/n", 2000.0).age == NOTHING


def test_a_window_without_messages_is_silence(statistics):
    tally = statistics.take(message(values=(NAN, NAN, NAN, NAN, 0.0)), "g", "/ns/n", 2000.0)
    assert (tally.count, tally.period) == (0, NOTHING)


def test_ages_of_another_window_or_subscription_are_not_mixed_in(statistics):
    age = message("message_age", (20.0, 10.0, 30.0, 5.0, 10.0))
    statistics.take(age, "other", "/ns/n", 2000.0)
    assert statistics.take(message(), "g", "/ns/n", 2000.0).age == NOTHING
    statistics.take(age, "g", "/ns/n", 2000.0)
    assert statistics.take(message(stop=1002), "g", "/ns/n", 2001.0).age == NOTHING


def test_several_publishers_leave_it_open_which(statistics):
    statistics.choose(graph("/scan", publishers=("/p", "/q")))
    assert statistics.take(message(), "g", "/ns/n", 2000.0).publisher == ""


@pytest.mark.parametrize(("subscribed", "node"), [(("/scan", "/odom"), "/ns/n"), ((), "/ns/n"), (("/scan",), None)])
def test_a_topic_that_cannot_be_told_is_named_once(statistics, subscribed, node):
    statistics.choose(graph(*subscribed))
    for _ in range(3):
        assert statistics.take(message(), "g", node, 2000.0) is None
    (failure,) = statistics.failures()
    assert "without naming its topic" in failure.what
    assert failure.partial
    assert statistics.failures() == []


@pytest.mark.parametrize("odd", [{"unit": "furlong"}, {"source": "cpu"}, {"start": 2000}, {"stop": 9000}])
def test_other_metrics_are_refused(statistics, odd):
    assert statistics.take(message(**odd), "g", "/ns/n", 2000.0) is None
    assert len(statistics.failures()) == 1


@pytest.mark.parametrize(
    "values", [(), (1.0,), (1.0, 2.0, 3.0, 4.0, -1.0), (NAN, 1.0, 1.0, 1.0, 3.0), (1, 1, 1, 1, 1e300)]
)
def test_incomplete_points_are_nothing(values):
    assert moments_of(points(*values), 1.0) == NOTHING
