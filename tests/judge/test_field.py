"""The field: percentiles by hand, and what ships."""

import re
from datetime import date

import pytest

from roslens.judge.quality.field import CURRENT, FEWEST, Distribution, load_field
from roslens.judge.quality.quality_model import load_model
from roslens.model.entity import EntityKind
from roslens.source.metrics.table import QUANTITIES


def distribution(*quantiles):
    return Distribution("loc", EntityKind.PACKAGE, 100, tuple(map(float, quantiles)))


@pytest.mark.parametrize(
    ("value", "percentile"),
    [(-1, 0), (0, 0), (5, 12.5), (10, 25), (15, 37.5), (40, 100), (41, 100)],
)
def test_between_quantiles(value, percentile):
    assert distribution(0, 10, 20, 30, 40).percentile(value) == percentile


def test_equal_values_count_half():
    # The least half of all packages have none: a package with none has half of them below.
    assert distribution(0, 0, 0, 3, 9).percentile(0) == 25
    assert distribution(0, 0, 0, 3, 9).percentile(1) == pytest.approx(50 + 25 / 3)
    assert distribution(7, 7, 7, 7, 7).percentile(7) == 50


def test_values_at_percentiles():
    one = distribution(0, 10, 20, 30, 40)
    assert [one.value_at(p) for p in (0, 25, 90, 100)] == [0, 10, 36, 40]
    assert one.percentile(one.value_at(63)) == pytest.approx(63)


def test_what_ships():
    field = load_field()
    assert field.name == CURRENT
    assert field.packages > 1000
    date.fromisoformat(field.day)
    assert len(field.repositories) >= 100
    assert len({one.name for one in field.repositories if one.generation == "ros1"}) >= 40
    assert sum(one.generation == "ros2" and one.day >= "2022" for one in field.repositories) >= 60
    for one in field.repositories:
        assert re.fullmatch(r"[0-9a-f]{40}", one.commit)
        assert one.url.startswith("https://")
        date.fromisoformat(one.day)


def test_distributions_are_whole():
    field = load_field()
    seen = set()
    for one in field.distributions:
        key = (one.quantity, one.kind, one.group)
        assert key not in seen
        seen.add(key)
        assert one.n >= FEWEST
        assert one.quantity.partition(".")[0] in QUANTITIES
        assert list(one.quantiles) == sorted(one.quantiles)
    for quantity in ("loc", "cyclomatic_complexity", "comment_ratio", "cbo"):
        for group in ("", "role=driver", "role=library", "language=cpp", "language=python", "generation=ros1"):
            if (quantity, group) != ("cbo", "language=python"):
                assert field.find(quantity, EntityKind.PACKAGE, group), (quantity, group)
    assert field.find("loc", EntityKind.PACKAGE, "role=unheard") is None


def test_the_model_has_the_fields_bounds():
    field, model = load_field(), load_model(CURRENT, QUANTITIES)
    assert len(model.constraints) > 12
    for one in model.constraints:
        found = field.find(one.quantity, one.kind)
        bound, share = (one.range.minimum, 10) if one.range.maximum is None else (one.range.maximum, 90)
        assert bound == pytest.approx(found.value_at(share), rel=1e-4)
