"""Patterns on paths."""

from __future__ import annotations

import re
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pace import slowness

from roslens.source.workspace.globs import compiled


@pytest.mark.parametrize(
    ("pattern", "path", "matches"),
    [
        ("a/b.py", "a/b.py", True),
        ("a/b.py", "x/a/b.py", False),
        ("a", "a/b/c.py", True),
        ("a", "x/a/c.py", True),
        ("/a", "x/a/c.py", False),
        ("a/", "a/c.py", True),
        ("./a", "a/c.py", True),
        ("./a", "x/a/c.py", False),
        ("*.gen.cpp", "deep/er/x.gen.cpp", True),
        ("*.cpp", "a/x.cpp.txt", False),
        ("a/*.py", "a/b/c.py", False),
        ("a/**/*.py", "a/c.py", True),
        ("a/**/*.py", "a/b/d/c.py", True),
        ("**/gen/*.py", "gen/c.py", True),
        ("**/gen/*.py", "x/gen/c.py", True),
        ("a/**", "a/b", True),
        ("a/**", "ab/c", False),
        ("a?c", "abc", True),
        ("a?c", "a/c", False),
        ("[ab].py", "b.py", True),
        ("[!ab].py", "c.py", True),
        ("[!ab].py", "a.py", False),
        ("[a-c].py", "b.py", True),
        ("a[.py", "a[.py", True),
        ("a[]].py", "a].py", True),
        ("[z-a]", "[z-a]", True),
        ("a.py", "axpy", False),
        ("a+(b)", "a+(b)", True),
        ("**", "anything/at/all", True),
    ],
)
def test_what_matches(pattern: str, path: str, matches: bool) -> None:
    expression = compiled([pattern])
    assert expression is not None
    assert bool(expression.fullmatch(path)) is matches


def test_no_pattern_is_nothing() -> None:
    assert compiled([]) is None
    assert compiled(["", "/"]) is None


@given(pattern=st.text(max_size=12))
def test_any_pattern_compiles(pattern: str) -> None:
    compiled([pattern])


@given(
    path=st.text(st.characters(exclude_characters="*?[]\0", codec="utf-8"), min_size=1).filter(lambda t: t.strip("/."))
)
def test_a_path_without_wildcards_matches_itself(path: str) -> None:
    path = path.strip("/")
    expression = compiled(["/" + path])
    assert expression is not None
    assert expression.fullmatch(path.removeprefix("./"))


def plainly(pattern: str) -> re.Pattern[str]:
    """Return the expression that means the same and may take for ever."""

    def part(text: str) -> str:
        return "".join({"*": "[^/]*", "?": "[^/]"}.get(sign, re.escape(sign)) for sign in text)

    parts = pattern.strip("/").removeprefix("./").split("/")
    if len(parts) == 1 and not pattern.startswith(("/", "./")):
        written = "(?:.*/)?" + part(parts[0])
    else:
        written = ""
        for number, one in enumerate(parts):
            last = number == len(parts) - 1
            written += (".+" if last else "(?:.*/)?") if one == "**" else part(one) + ("" if last else "/")
    return re.compile(f"(?:{written})(?:/.*)?", re.DOTALL)


@given(
    pattern=st.lists(st.sampled_from(["a", "b", "*", "?", "/", "/**/"]), min_size=1, max_size=8).map("".join),
    path=st.lists(st.sampled_from(["a", "b", "aa", "ab"]), min_size=1, max_size=5).map("/".join),
)
def test_a_first_match_for_good_misses_none(pattern: str, path: str) -> None:
    expression = compiled([pattern])
    if expression is not None and "//" not in pattern and "***" not in pattern:
        assert bool(expression.fullmatch(path)) is bool(plainly(pattern).fullmatch(path))


@pytest.mark.parametrize("pattern", ["*a" * 20 + "b", "**/a/" * 25 + "b", "*a*/" * 12 + "**/*b*c"])
def test_no_pattern_takes_long(pattern: str) -> None:
    expression = compiled([pattern])
    assert expression is not None
    begun = time.process_time()
    assert not expression.fullmatch("a" * 250)
    assert not expression.fullmatch("/".join(["a" * 20] * 100))
    assert not expression.fullmatch("a/" * 1000 + "a")
    assert time.process_time() - begun < 1 * slowness()
