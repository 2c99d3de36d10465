from hypothesis import given
from hypothesis import strategies as st

from roslens.store.live.series import TIERS, DownSampler, Tier, tier_for

TWO = (Tier(1, 10), Tier(10, 100))


def fed(values, tiers=TWO):
    """Return the points by tier of one series."""
    sampler = DownSampler(tiers)
    found = {tier.seconds: [] for tier in tiers}
    given_out = [one for time, value in values for one in sampler.add("host:a", time, {"cpu": value})]
    for _, _, tier, point in [*given_out, *sampler.rest()]:
        found[tier.seconds].append(point)
    return found


def test_points_of_both_tiers():
    points = fed([(0.1, 1.0), (0.9, 3.0), (1.0, 5.0), (12.0, 7.0)])
    assert [(one.time, one.count, one.mean, one.least, one.greatest) for one in points[1]] == [
        (0, 2, 2.0, 1.0, 3.0),
        (1, 1, 5.0, 5.0, 5.0),
        (12, 1, 7.0, 7.0, 7.0),
    ]
    assert [(one.time, one.count, one.mean) for one in points[10]] == [(0, 3, 3.0), (10, 1, 7.0)]


@given(st.lists(st.tuples(st.integers(0, 500), st.floats(-1e6, 1e6)), min_size=1))
def test_every_value_is_in_one_point_of_each_tier(values):
    ordered = sorted(values)
    for points in fed(ordered).values():
        assert sum(point.count for point in points) == len(values)
        assert min(point.least for point in points) == min(value for _, value in values)
        assert max(point.greatest for point in points) == max(value for _, value in values)
        times = [point.time for point in points]
        assert times == sorted(set(times))


def test_what_is_late_or_no_number_is_left_out():
    sampler = DownSampler(TWO)
    list(sampler.add("host:a", 20.0, {"cpu": 1.0}))
    assert list(sampler.add("host:a", 5.0, {"cpu": 9.0})) == []
    assert list(sampler.add("host:a", 20.5, {"cpu": float("nan"), "load": float("inf")})) == []
    assert sampler.late == 1
    assert [point.count for _, _, _, point in sampler.rest()] == [1, 1]


def test_silent_series_are_forgotten():
    sampler = DownSampler(TWO)
    list(sampler.add("host:a", 20.0, {"cpu": 1.0}))
    list(sampler.add("host:b", 90.0, {"cpu": 1.0}))
    assert {entity for entity, _, _, _ in sampler.forget(50.0)} == {"host:a"}
    assert {entity for entity, _, _, _ in sampler.rest()} == {"host:b"}


def test_the_tier_fits_the_question():
    assert tier_for(600, 600).seconds == 1
    assert tier_for(3600, 600).seconds == 10
    assert tier_for(86_400, 2000).seconds == 60
    assert tier_for(365 * 86_400, 100).seconds == TIERS[-1].seconds
