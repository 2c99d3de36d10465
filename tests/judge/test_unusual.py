from roslens.judge.quality.field import distributions_of
from roslens.judge.quality.unusual import LOOKED_AT, Unusual, most_unusual, percentiles
from roslens.model.entity import EntityKind


def test_the_field_knows_what_is_looked_at():
    for kind, keys in LOOKED_AT.items():
        assert set(keys) <= distributions_of(kind).keys()


def test_what_stands_highest_is_told():
    known = distributions_of(EntityKind.FUNCTION)
    deep = known["nesting"].quantiles[-1] + 1
    usual = known["parameters"].value_at(50)
    assert most_unusual(EntityKind.FUNCTION, {"parameters": usual, "nesting": deep}) == Unusual("nesting", deep, 100.0)
    # More lines are nobody's fault.
    assert most_unusual(EntityKind.FUNCTION, {"loc": 1e6}) is None
    assert most_unusual(EntityKind.LAUNCH_FILE, {"loc": 1e6}) is None


def test_percentiles_of_what_the_field_knows():
    found = percentiles(EntityKind.PACKAGE, {"loc": 1e9, "mine": 3.0, "cbo.max": -1.0})
    assert found == {"cbo.max": 0.0, "loc": 100.0}
