import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.window.host_clocks import HostClocks
from roslens.model.entity import EntityId, EntityKind
from roslens.model.traffic.sample import Sample
from roslens.model.traffic.tally import NOTHING, Moments, Tally


def moments(values):
    return Moments(len(values), sum(values), sum(value * value for value in values), min(values), max(values))


def clocks(**known):
    found = HostClocks()
    for host, (offset, bound) in known.items():
        values = {"clock_offset": offset, "clock_bound": bound}
        found.take(Sample(EntityId(EntityKind.HOST, host), 1.0, values))
    return found


def tally(latency=(0.001,), age=()):
    return Tally("/scan", "/lidar", "/planner", 0.0, 1.0, 3, latency=moments(latency) if latency else NOTHING,
                 age=moments(age) if age else NOTHING)  # fmt: skip


KNOWN = clocks(base=(0.0, 0.0), sensor=(0.25, 0.001), brain=(-0.1, 0.002))


@given(st.lists(st.floats(0, 1), min_size=1, max_size=9), st.floats(-5, 5), st.floats(-5, 5))
def test_the_difference_of_two_clocks_is_taken_out_of_a_latency(true, sender, receiver):
    shown = tally([one + receiver - sender for one in true])
    found = clocks(a=(sender, 0.0), b=(receiver, 0.0)).corrected(shown, "a", "b", 0.01).latency
    for name in ("count", "total", "squares", "least", "greatest"):
        assert getattr(found, name) == pytest.approx(getattr(moments(true), name), abs=1e-9)


def test_on_one_host_nothing_is_corrected():
    assert KNOWN.corrected(tally(age=[0.1]), "sensor", "sensor", 0.001) == tally(age=[0.1])


@pytest.mark.parametrize(("tolerance", "known"), [(0.0031, True), (0.0029, False)])
def test_a_latency_is_unknown_where_the_bounds_of_the_clocks_are_wider_than_it_may_be_wrong(tolerance, known):
    latency = KNOWN.corrected(tally([0.351]), "brain", "sensor", tolerance).latency
    assert latency.mean == (pytest.approx(0.001) if known else None)


def test_a_publisher_anywhere_may_have_any_clock():
    assert KNOWN.corrected(tally(), "", "base", 0.1).latency == NOTHING
    alike = clocks(base=(0.0, 0.0), sensor=(0.001, 0.001))
    assert alike.corrected(tally(), "", "base", 0.005).latency.mean == pytest.approx(0.002)


def test_a_host_without_an_agent_has_no_clock_that_is_known():
    assert KNOWN.corrected(tally(), "arm", "base", 1e9).latency == NOTHING


def test_an_age_is_not_corrected_but_unknown_where_clocks_differ():
    assert KNOWN.corrected(tally(age=[0.1]), "sensor", "base", 0.01).age == NOTHING
    assert KNOWN.corrected(tally(age=[0.1]), "sensor", "base", 0.3).age == moments([0.1])


def test_one_clock_is_no_reason_to_correct():
    assert not clocks(base=(0.0, 0.0)).several
    assert KNOWN.several
    other = HostClocks()
    other.take(Sample(EntityId(EntityKind.HOST, "a"), 1.0, {"clock_offset": 1.0}))
    other.take(Sample(EntityId(EntityKind.NODE, "/a"), 1.0, {"clock_offset": 1.0, "clock_bound": 1.0}))
    assert not other.several


def test_what_arrives_before_it_is_sent_shows_a_clock_that_was_set():
    known = clocks(base=(0.0, 0.0), brain=(0.0, 0.001))
    assert known.corrected(tally([-0.25]), "brain", "base", 0.01).latency == NOTHING
    assert known.corrected(tally([-0.01]), "brain", "base", 0.01).latency == moments([-0.01])
