"""Patterns on names: against slow oracles, and against names that mean harm."""

from __future__ import annotations

import itertools
import re
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pace import turned_s

from roslens.judge.patterns.pattern import Pattern


@pytest.mark.parametrize(
    ("text", "matching", "others"),
    [
        ("/scan", ["/scan"], ["/scan2", "scan", "/a/scan", ""]),
        ("/*/scan", ["/a/scan", "//scan"], ["/scan", "/a/b/scan"]),
        ("/**/scan", ["/a/scan", "/a/b/scan", "//scan"], ["/scan"]),
        ("**", ["", "/", "/a/b", "192.168.0.1"], []),
        ("*", ["", "robot-1"], ["/", "a/b"]),
        ("/r?", ["/r1", "/rü"], ["/r", "/r12", "/r/"]),
        ("/{left,right}/**", ["/left/x", "/right/"], ["/left", "/up/x"]),
        ("/{a,{b,c}d}/{,x}", ["/a/", "/bd/x", "/cd/"], ["/d/", "/a/y"]),
        (r"/a\*b\\", ["/a*b\\"], ["/axb\\", r"/a\*b\\"]),
        ("/a,b", ["/a,b"], ["/a"]),
        ("[::1]", ["[::1]"], [":", "1"]),
        ("[::*]", ["[::1]", "[::ffff]"], ["::1"]),
        ("/robot-1/**", ["/robot-1/naïve"], ["/robot_1/x"]),
        (
            "re:/cam[0-9]+/image(_raw)?",
            ["/cam0/image", "/cam12/image_raw"],
            ["/cam/image", "/cam1/image/x", "x/cam1/image"],
        ),
        ("re:^/a/?$", ["/a", "/a/"], ["/a/b"]),
        (r"re:(?i)/\w+-\d{2,3}", ["/Ä-12", "/x-123"], ["/x-1", "/-12", "/x-1234"]),
        ("re:[^/]*?x", ["x", "ax"], ["/x"]),
    ],
)
def test_what_a_pattern_matches(text: str, matching: list[str], others: list[str]):
    pattern = Pattern.parse(text)
    assert [name for name in matching if not pattern.matches(name)] == []
    assert [name for name in others if pattern.matches(name)] == []


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "empty"),
        ("/a/{b", r"'\{' without '\}'"),
        ("/a/b}", r"'\}' without '\{'"),
        ("/a/***", "write `\\*\\*` for any text"),
        ("/a\\", "ends in a backslash"),
        ("*a" * 101, "101 stars in the pattern"),
        ("{" * 30 + "}" * 30, "more than 20 braces"),
        ("re:", "empty"),
        ("re:(a", "is not a regular expression: missing"),
        (r"re:(a)\1", "has a reference to a group"),
        ("re:(?!/tmp).*", "use `without` to leave names out"),
        ("re:(a{100}){100}", "repeats too much"),
        ("re:a{99999}", "repeats too much"),
        ("re:a$b", "anchor inside"),
        ("re:^/a|/b$", "anchor inside"),
        ("re:(?m)a", "has flags"),
        ("re:" + "(" * 5000 + ")" * 5000, "regular expression"),
    ],
)
def test_a_wrong_pattern_says_why(text: str, reason: str):
    with pytest.raises(ValueError, match=reason):
        Pattern.parse(text)


@pytest.mark.parametrize(
    ("text", "literal"),
    [("/scan", "/scan"), (r"/a\*", "/a*"), ("/a,b", "/a,b"), ("/*", None), ("/{a}", None), ("re:/scan", None)],
)
def test_a_name_without_wildcards_is_literal(text: str, literal: str | None):
    assert Pattern.parse(text).literal == literal


SIGNS = st.sampled_from(["a", "b", "/", "*", "**", "?", r"\*", "é"])
ALTERNATIVES = st.recursive(
    st.lists(SIGNS, max_size=4).map("".join),
    lambda inner: st.tuples(inner, st.lists(inner, min_size=1, max_size=3).map(",".join), inner).map(
        lambda parts: f"{parts[0]}{{{parts[1]}}}{parts[2]}"
    ),
    max_leaves=5,
).filter(lambda text: text and "***" not in text)
NAME = st.text("ab/*é", max_size=8)


def oracle(pattern: str) -> re.Pattern[str]:
    """A glob as a regular expression of Python."""
    out, depth, at = "", 0, 0
    while at < len(pattern):
        if pattern.startswith("**", at):
            out, at = out + "(?s:.*)", at + 2
            continue
        char = pattern[at]
        if char == "\\":
            out, at = out + re.escape(pattern[at + 1]), at + 2
            continue
        depth += (char == "{") - (char == "}")
        out += {"*": "[^/]*", "?": "[^/]", "{": "(?:", "}": ")"}.get(char) or (
            "|" if char == "," and depth else re.escape(char)
        )
        at += 1
    return re.compile(out)


@given(ALTERNATIVES, NAME)
def test_globs_match_what_the_oracle_matches(text: str, name: str):
    assert Pattern.parse(text).matches(name) == (oracle(text).fullmatch(name) is not None)


@given(ALTERNATIVES, st.data())
def test_globs_match_names_made_from_them(text: str, data: st.DataObject):
    name = data.draw(st.from_regex(oracle(text), fullmatch=True))
    assert Pattern.parse(text).matches(name)


EXPRESSION = st.recursive(
    st.sampled_from(["a", "b", "/", "[ab]", "[^a]", ".", r"\w", r"\.", "é", ""]),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map("".join),
        st.tuples(inner, inner).map("|".join).map("({})".format),
        st.tuples(inner, st.sampled_from(["*", "+", "?", "{1,3}", "*?", "{2}"])).map(lambda it: f"(?:{it[0]}){it[1]}"),
    ),
    max_leaves=6,
).filter(bool)


@settings(deadline=None)
@given(EXPRESSION, st.text("ab/é.\n", max_size=7))
def test_regular_expressions_match_what_python_matches(expression: str, name: str):
    assert Pattern.parse(f"re:{expression}").matches(name) == (re.fullmatch(expression, name) is not None)


SMALL = [
    "".join(chars) for length in range(6) for chars in itertools.product("ab/", repeat=length)
]  # every name up to five characters
TINY = st.lists(st.sampled_from(["a", "b", "/", "*", "**", "?", "{a,/b}", "{,ab}"]), min_size=1, max_size=4).map(
    "".join
)


@settings(max_examples=300, deadline=None)
@given(TINY.filter(lambda text: "***" not in text), TINY.filter(lambda text: "***" not in text))
def test_two_globs_intersect_when_some_small_name_matches_both(one: str, other: str):
    first, second = oracle(one), oracle(other)
    common = any(first.fullmatch(name) and second.fullmatch(name) for name in SMALL)
    answer = Pattern.parse(one).intersects(Pattern.parse(other))
    assert answer == Pattern.parse(other).intersects(Pattern.parse(one))
    if common:
        assert answer
    elif answer:
        # Four pieces of at most two characters each on both sides can need longer names than five characters.
        longer = ("".join(chars) for length in (6, 7, 8) for chars in itertools.product("ab/", repeat=length))
        assert any(first.fullmatch(name) and second.fullmatch(name) for name in longer)


@pytest.mark.parametrize(
    ("one", "other", "both"),
    [
        ("/a/*", "/*/b", True),
        ("/a/*", "/b/*", False),
        ("/*", "/a/b", False),
        ("/**/x", "/*/y", False),
        ("/x?", "/x", False),
        ("é*", "*é", True),
        ("?", "/", False),
        ("re:a+", "b", False),
        ("re:a+", "aa", True),
        ("re:[0-9]+", "a*", True),
    ],
)
def test_intersections_told_by_hand(one: str, other: str, both: bool):
    # A regular expression with a set of characters may give a false yes (the last row), never a false no.
    assert Pattern.parse(one).intersects(Pattern.parse(other)) is both
    assert Pattern.parse(other).intersects(Pattern.parse(one)) is both


@pytest.mark.parametrize(
    "text",
    ["/*a*a*a*a*a*a*a*b", "re:/(a+)+b", "re:/(a|aa)*b", "/{a,aa,**}{a,aa,**}b", "/**a**a**b", "/" + "*a" * 99 + "*b"],
)
@pytest.mark.timed
def test_hostile_names_take_no_longer_than_their_length(text: str):
    pattern = Pattern.parse(text)
    started = time.process_time()
    assert not pattern.matches("/" + "a" * 10_000 + "c")
    assert pattern.matches("/" + "a" * 10_000 + "b")
    assert turned_s(started) < 1.0


def test_many_different_names_do_not_fill_the_memory():
    pattern = Pattern.parse("/*x")
    for plane in range(60):
        name = "/" + "".join(chr(0x1000 + plane * 900 + at) for at in range(900))
        assert pattern.matches(name + "x")
        assert not pattern.matches(name)
    assert sum(map(len, pattern.automaton._steps)) < 25_000
