"""What a file's lines hold: counted on the way where that is the same as what cloc counts."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.syntax.comments import blank_cpp
from roslens.source.syntax.cpp_lines import LineMap
from roslens.source.syntax.facts import Lines
from roslens.source.syntax.lines import BYTE_ORDER_MARKS, count_lines
from roslens.source.syntax.text_lines import TextLines
from roslens.source.syntax.tokens import line_hashes, squeezed_lines

_PIECES = [
    b"/*", b"*/", b"/* a\n */", b"//", b"\n", b"\n", b" ", b"\t", b"a", b'"', b'"b"', b"'", b"\\", b"\\\n", b"/", b"*",
    b"#include <", b">", b'R"(', b')"', b"\r", b"\f", b"\x01", b"\xff", b"1'0", b"foo();", b"\0",
]  # fmt: skip


def _map(content: bytes) -> LineMap:
    return LineMap(TextLines(content), squeezed_lines(blank_cpp(content)[0]))


@given(st.lists(st.sampled_from(_PIECES), max_size=14).map(b"".join))
def test_a_plain_file_has_the_lines_that_cloc_counts(content):
    plain = blank_cpp(content)[1] and not content.startswith(BYTE_ORDER_MARKS)
    assert not plain or _map(content).whole() == count_lines(content, "cpp")


@pytest.mark.parametrize(
    "content",
    [
        b'a; // b\n/* c\n * d */\n\nchar *e = "f\\n", g = \'"\';\n',
        b"#include <a/b.h>\nint a /* b */ = 1;",
        b"",
    ],
)
def test_plain_files(content):
    assert blank_cpp(content)[1]
    assert _map(content).whole() == count_lines(content, "cpp")


@pytest.mark.parametrize(
    "content",
    [
        b'char *a = "http://b";\n',
        b'char *a = "/*";\n',
        b"a /*\n*/ b\n",
        b"/*\n*/ // a\n",
        b"/* a\n",
        b"/*/",
        b"#define A \\\n  b\n",
        b"\\/**/\n a\n",
        b"// a \\\\\nb\n",
        b"\\\\\n",
        b"a\r\n",
        b"\x01\n",
        b'R"(//)"\n',
    ],
)
def test_files_that_are_not_plain(content):
    assert not blank_cpp(content)[1]


@given(st.lists(st.sampled_from(_PIECES), max_size=14).map(b"".join))
def test_hashes_and_numbers_are_those_of_the_code_lines(content):
    lines = _map(content)
    assert (lines.hashes, lines.numbers) == line_hashes(content, "cpp")


def test_directives_are_not_executed_but_a_statement_on_their_line_is():
    lines = _map(b"#define A 1\n  # if A\n#include <a>\na = 1;\nb = '#';\n/* c */ #endif\n")
    lines.leave_out((), ())
    assert [lines.executed(line, line) for line in range(1, 7)] == [0, 0, 0, 1, 1, 0]
    lines = _map(b"#define A 1\na;\n")
    lines.leave_out((), (8,))
    assert lines.executed(1, 2) == 2


def test_whole():
    assert _map(b"a\n\n// b\nc").whole() == Lines(4, 2, 1, 1)
