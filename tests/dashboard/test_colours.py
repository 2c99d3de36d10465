"""Colours: what they mean in each language, and that they never change a character."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.dashboard.sources.colours import colour


def pieces(text: str, language: str) -> list[tuple[str, str]]:
    """Return what is coloured in the lines of ``text``."""
    return [piece for line in colour(text.split("\n"), language) for piece in line if piece[0]]


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [
        ("cpp", "return 42; // done", [("k", "return"), ("m", "42"), ("c", "// done")]),
        ("cpp", "class Base final {", [("k", "class"), ("f", "Base"), ("k", "final")]),
        ("cpp", "/* a\nb */ int", [("c", "/* a"), ("c", "b */"), ("t", "int")]),
        ("python", "def run(self):", [("k", "def"), ("f", "run"), ("t", "self")]),
        ("python", "'''c\nd''' or None", [("s", "'''c"), ("s", "d'''"), ("k", "or"), ("k", "None")]),
        ("cmake", "run(a)  # e", [("t", "run"), ("s", "a"), ("c", "# e")]),
        ("launch_xml", '<n p="a"/><!--b-->', [("k", "<n"), ("t", "p="), ("s", '"a"'), ("k", "/>"), ("c", "<!--b-->")]),
        ("yaml", "a_b: 'c' # d", [("k", "a_b"), ("s", "'c'"), ("c", "# d")]),
        ("msg", "int32 a # b", []),
    ],
)  # fmt: skip
def test_what_is_coloured(language: str, text: str, expected: list[tuple[str, str]]) -> None:
    assert pieces(text, language) == expected


def test_a_line_without_anything_is_empty() -> None:
    assert colour(["/* a", ""], "cpp") == [(("c", "/* a"),), ()]
    assert colour(["a", ""], "msg") == [(("", "a"),), ()]


@given(
    st.text(alphabet="ab\"'/*#\\\n\t{}<>()[]:@0._=$-\x0c\u2028R", max_size=80),
    st.sampled_from(["cpp", "python", "cmake", "yaml", "xml", "msg"]),
)
def test_colours_change_no_character(text: str, language: str) -> None:
    lines = text.split("\n")
    assert ["".join(piece for _, piece in line) for line in colour(lines, language)] == lines
