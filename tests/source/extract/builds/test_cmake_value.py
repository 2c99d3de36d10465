"""Values of CMake: lists, constants, versions, regular expressions, and what is unknown."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pace import soon

from roslens.source.extract.builds.cmake_value import (
    expression_of,
    hole,
    is_off,
    is_unknown,
    items_of,
    number_of,
    reason_of,
    searchable,
    shown,
    truth_of,
    versions_compared,
)


@pytest.mark.parametrize(
    ("value", "items"),
    [
        ("", []),
        ("a", ["a"]),
        ("a;b", ["a", "b"]),
        ("a;;b;", ["a", "b"]),
        (r"a\;b;c", ["a;b", "c"]),
        ("[a;b];c", ["[a;b]", "c"]),
    ],
)
def test_items(value, items):
    assert items_of(value) == items


def test_empty_items_count_in_lists():
    assert items_of("a;;b", empty=True) == ["a", "", "b"]


@pytest.mark.parametrize(
    ("value", "truth"),
    [("ON", True), ("y", True), ("1", True), ("-2.5", True), ("0", False), ("0.0", False), ("", False),
     ("x-NOTFOUND", False), ("IGNORE", False), ("text", None), ("1x", None),
     ("0x10", True), ("-0x0", False), ("inf", True), ("nan", True), (" 1", True), ("1 ", None), ("1e", None)],
)  # fmt: skip
def test_truth(value, truth):
    assert truth_of(value) is truth


def test_numbers_and_versions():
    assert number_of("1.5") == 1.5
    assert number_of("1.5.2") == 1.5
    assert number_of(" 0x10") == 16
    assert number_of("x1") is None
    assert versions_compared("1.10.2.0", "1.10.2") == 0
    assert versions_compared("2.x.1", "2") == 0
    assert versions_compared("1.9", "1.10") == -1
    assert versions_compared("1..2", "1.0.1") == 1
    assert versions_compared("12", "-3") == -1


def test_holes():
    value = f"src/{hole('who knows; what')}.cpp"
    assert is_unknown(value)
    assert reason_of(value) == "who knows, what"
    assert shown(value) == "src/{who knows, what}.cpp"
    assert items_of(f"a;{value}") == ["a", value]


@pytest.mark.parametrize(
    ("pattern", "text", "found"),
    [
        ("^a.*c$", "abc", "abc"),
        (r"\.cpp$", "x.cpp", ".cpp"),
        ("[^/]+$", "a/b", "b"),
        ("a{2}", "a{2}", "a{2}"),
        ("[]x]", "]", "]"),
    ],
)
def test_regular_expressions(pattern, text, found):
    assert expression_of(pattern).search(text)[0] == found


@pytest.mark.parametrize("pattern", ["(a*)*b", "(a+)+", "(?P<x>a)", "[", "(", "*"])
def test_expressions_that_are_not_taken(pattern):
    assert expression_of(pattern) is None


@given(st.text("ab()[]*+?|^$.\\", max_size=12), st.text("ab", max_size=300))
def test_a_search_ends_soon(pattern, text):
    expression = expression_of(pattern)
    if expression is not None and searchable(expression, text):
        with soon(2):
            expression.search(text)


def test_brackets_and_escapes_in_lists():
    assert items_of("a]b;c") == ["a]b;c"]
    assert items_of("[a;b];c") == ["[a;b]", "c"]
    assert items_of("a\\;b;c\\[;d") == ["a;b", "c\\[;d"]


@pytest.mark.parametrize(
    ("value", "off"), [("x-NOTFOUND", True), ("x-notfound", False), ("ignore", True), ("0.0", False)]
)
def test_values_of_variables_that_are_false(value, off):
    assert is_off(value) is off
