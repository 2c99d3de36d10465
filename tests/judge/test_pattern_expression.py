import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.pattern_expression import expression_of

PIECES = st.sampled_from(["*", "**", "?", "/", "a", "b", "scan", "{a,b}", "{,**/}", ".", "[x]", "\\*", "+"])
NAMES = st.text(alphabet="ab/s.[x]*+", max_size=8)


@given(st.lists(PIECES, min_size=1, max_size=6).map("".join), NAMES)
def test_an_expression_matches_what_its_pattern_matches(pattern, name):
    try:
        parsed = Pattern.parse(pattern)
    except ValueError:
        return
    expression = expression_of(pattern)
    assert expression is not None
    assert bool(re.fullmatch(expression, name, re.DOTALL)) == parsed.matches(name)


@pytest.mark.parametrize(
    ("pattern", "expression"),
    [("/scan", "/scan"), ("/*/scan", "/[^/]*/scan"), ("/{a,b}", "(?:/a|/b)"), ("re:/scan_[0-9]+", "/scan_[0-9]+")],
)
def test_expressions_are_short(pattern, expression):
    assert expression_of(pattern) == expression


@pytest.mark.parametrize("pattern", ["re:/scan(?#front)", r"re:/scan\Z", r"re:\N{DIGIT ONE}", "re:(?x)/scan"])
def test_what_re2_does_not_have_is_none(pattern):
    assert Pattern.parse(pattern)
    assert expression_of(pattern) is None
