"""Patterns on paths."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

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
