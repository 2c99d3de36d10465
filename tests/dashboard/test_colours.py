"""Colours: what they mean in each language, and that they never change a character."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.dashboard.colours import colour


def pieces(text: str, language: str) -> list[tuple[str, str]]:
    """Return what is coloured in the lines of ``text``."""
    return [piece for line in colour(text.split("\n"), language) for piece in line if piece[0]]


def numbers(text: str) -> list[tuple[str, str]]:
    return [("m", one) for one in text.split()]


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("return 42; // done", [("k", "return"), ("m", "42"), ("c", "// done")]),
        (r'const char * c = "a \" // b";', [("k", "const"), ("t", "char"), ("s", r'"a \" // b"')]),
        ("auto t = 100ms + 1'000 - 0x1Fu + .5e-3;", [("k", "auto"), *numbers("100ms 1'000 0x1Fu .5e-3")]),
        ("char c = 'x'; // it's", [("t", "char"), ("s", "'x'"), ("c", "// it's")]),
        ("#include <vector>  // for it", [("p", "#include <vector>  "), ("c", "// for it")]),
        ('  #define A "//" + 1', [("p", '  #define A "//" + 1')]),
        ('auto r = R"x(a)" b)x"; int i;', [("k", "auto"), ("s", 'R"x(a)" b)x"'), ("t", "int")]),
        ("class Base final {", [("k", "class"), ("f", "Base"), ("k", "final")]),
        ("void Node::start(int a)", [("t", "void"), ("f", "start"), ("t", "int")]),
        ("Node::Node()", [("f", "Node")]),
        ("  virtual ~Node() = default;", [("k", "virtual"), ("f", "Node"), ("k", "default")]),
        ("  std::move(a);", []),
        ("  return make(a);", [("k", "return")]),
        ("  a = make(b);", []),
        ("integer forget;", []),
    ],
)  # fmt: skip
def test_cpp(line: str, expected: list[tuple[str, str]]) -> None:
    assert pieces(line, "cpp") == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("def run(self):", [("k", "def"), ("f", "run"), ("t", "self")]),
        ("class Node(Base):  # here", [("k", "class"), ("f", "Node"), ("c", "# here")]),
        ("@decorated.by(1)", [("p", "@decorated.by"), ("m", "1")]),
        ("x = rb'a' f\"{b}#\"", [("s", "rb'a'"), ("s", 'f"{b}#"')]),
        ("'''c\nd''' or None", [("s", "'''c"), ("s", "d'''"), ("k", "or"), ("k", "None")]),
        ("'{}'.format(len(a))", [("s", "'{}'"), ("t", "len")]),
    ],
)
def test_python(text: str, expected: list[tuple[str, str]]) -> None:
    assert pieces(text, "python") == expected


@pytest.mark.parametrize(
    ("language", "text", "expected"),
    [
        ("cmake", "run(a b/c.cpp ${D})  # e", [("t", "run"), ("s", "a"), ("s", "b/c.cpp"), ("c", "# e")]),
        ("cmake", 'set(A "x ${B}")', [("t", "set"), ("s", "A"), ("s", '"x ${B}"')]),
        ("cmake", "#[[ all\nof it ]]\nif (A)", [("c", "#[[ all"), ("c", "of it ]]"), ("t", "if"), ("s", "A")]),
        ("launch_xml", '<n p="a"/><!--b-->', [("k", "<n"), ("t", "p="), ("s", '"a"'), ("k", "/>"), ("c", "<!--b-->")]),
        ("manifest", "<?xml?>\n<name>a</name>", [("p", "<?xml?>"), ("k", "<name>"), ("k", "</name>")]),
        ("yaml", "a_b: 'c' # d\n- e: http://f", [("k", "a_b"), ("s", "'c'"), ("c", "# d"), ("k", "e")]),
        ("yaml", "a: don't", [("k", "a")]),
        ("msg", "int32 a # b", []),
    ],
)  # fmt: skip
def test_other_languages(language: str, text: str, expected: list[tuple[str, str]]) -> None:
    assert pieces(text, language) == expected


def test_a_comment_goes_over_lines_and_an_unfinished_text_ends_with_its_line() -> None:
    assert pieces("/* a\nb */ int", "cpp") == [("c", "/* a"), ("c", "b */"), ("t", "int")]
    assert pieces('x = "a\nreturn', "cpp") == [("s", '"a'), ("k", "return")]
    assert colour(["/* a", ""], "cpp") == [(("c", "/* a"),), ()]


@given(
    st.text(alphabet="ab\"'/*#\\\n\t{}<>()[]:@0._=$-\x0c\u2028R", max_size=80),
    st.sampled_from(["cpp", "python", "cmake", "yaml", "xml", "msg"]),
)
def test_colours_change_no_character(text: str, language: str) -> None:
    lines = text.split("\n")
    assert ["".join(piece for _, piece in line) for line in colour(lines, language)] == lines
