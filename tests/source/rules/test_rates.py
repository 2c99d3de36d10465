"""How often rules report in the field is said of rules that there are, and of enough repositories."""

from roslens.source.rules.field.rates import Rates, read_rates, spoken_rate
from roslens.source.rules.table import native_rules

RATES = read_rates()


def test_it_is_said_in_words():
    rates = Rates(200_000, 40, {"cpp.a": (30, 7)})
    assert spoken_rate("cpp.a", rates) == "0.15 findings per 1,000 lines of own code, in 7 of 40 repositories."
    assert spoken_rate("cpp.b", rates) == ""


def test_the_field_is_large_enough_and_the_rules_exist():
    assert RATES.repositories >= 30
    assert RATES.rules.keys() <= native_rules().keys()
    assert all(0 < repositories <= min(count, RATES.repositories) for count, repositories in RATES.rules.values())
