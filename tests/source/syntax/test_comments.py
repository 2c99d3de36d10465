"""Comments are blanked in place; strings are words; nothing moves."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.syntax.comments import LINE_BREAK_IN_STRING, blank_comments

PIECES = [
    b"/*", b"*/", b"//", b'"', b"'", b'"""', b"'''", b"\\", b"\\\n", b"\n", b"\r\n", b"#", b"#include <a>", b'R"x(',
    b')x"', b"1'000", b"u8'a'", b"\xe9", b"\xff", b"\x00", b"\x02", b"name", b" ",
]  # fmt: skip


@pytest.mark.parametrize(
    ("source", "blanked"),
    [
        (b"a; // b\nc;", b"a;     \nc;"),
        (b"a /* b\n// c */ d", b"a     \n        d"),
        (b'x("// no") // yes', b"x(\xa2\xaf\xaf\xa0no\xa2)       "),
        (b'x("\\"") /* c */', b"x(\xa2\x84\x84\xa2)        "),
        (b'x("\\\\") /* c */', b"x(\xa2\x83\x83\xa2)        "),
        (b"x('\"') // c", b"x(\xa7\xa2\xa7)     "),
        (b"1'000'000 // c", b"1_000_000     "),
        (b"// a \\\n b\nc", b"      \n  \nc"),
        (b"a \\\n b", b"a  \n b"),
        (b"a \\\r\n b", b"a   \n b"),
        (b"/* never closed\nx", b"               \n "),
        (b'"never closed\nx // y', b"\xa2never\xa0closed\nx     "),
        (b'R"(a " // \n)" // c', b"R\xa2\xa8a\xa0\xa2\xa0\xaf\xaf\xa0\xff\xa9\xa2     "),
        (b"a\x00\x01b", b"a  b"),
    ],
)
def test_cpp(source, blanked):
    assert blank_comments(source, "cpp") == blanked


@pytest.mark.parametrize(
    ("source", "blanked"),
    [
        (b"a = 1  # b\nc", b"a = 1     \nc"),
        (b"a = '#' # b", b"a = \xa7\xa3\xa7    "),
        (b'def f():\n  """a\n  b"""  # c\n  x', b"def f():\n" + b" " * 6 + b"\n" + b" " * 11 + b"\n  x"),
        (b'a = """x\n# y"""', b"a = \xa2\xa2\xa2x\xff\xa3\xa0y\xa2\xa2\xa2"),
        (b"# a \\\nb", b"     \nb"),
        (b'def f():\n  r"""a"""\n  x', b"def f():\n" + b" " * 10 + b"\n  x"),
        (b'"""a""" "b"', b"\xa2\xa2\xa2a\xa2\xa2\xa2 \xa2b\xa2"),
        (b'"""a""" # b', b" " * 11),
        (b'"""a\n""" """b"""\n', b"\xa2\xa2\xa2a\xff\xa2\xa2\xa2 \xa2\xa2\xa2b\xa2\xa2\xa2\n"),
        (b"'' 'a'''b'", b"\xa7\xa7 \xa7a\xa7\xa7\xa7b\xa7"),
        (b"'a\\\n b'", b"\xa7a\x81\xff\xa0b\xa7"),
    ],
)
def test_python(source, blanked):
    assert blank_comments(source, "python") == blanked


@given(st.lists(st.sampled_from(PIECES)).map(b"".join), st.sampled_from(["cpp", "python"]))
def test_nothing_moves(content, syntax):
    blanked = blank_comments(content, syntax)
    assert len(blanked) == len(content)
    kept = [i for i, byte in enumerate(blanked) if byte in {0x0A, LINE_BREAK_IN_STRING}]
    assert kept == [i for i, byte in enumerate(content) if byte == 0x0A]


@pytest.mark.parametrize("piece", [b"/*", b"*a", b'"', b"\\a", b"'", b'R"x(', b"\\\n", b"'''", b'"""', b"#include <"])
@pytest.mark.parametrize("start", [b"", b'"', b"/*", b"//"])
@pytest.mark.parametrize("syntax", ["cpp", "python"])
def test_long_repetitions_take_linear_time(piece, start, syntax):
    content = start + piece * 200_000
    assert len(blank_comments(content, syntax)) == len(content)
