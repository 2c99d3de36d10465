"""Halstead's counts worked out by hand; hashes of lines that look the same are the same."""

from zlib import crc32

import pytest

from roslens.source.syntax.comments import blank_comments
from roslens.source.syntax.facts import Halstead
from roslens.source.syntax.tokens import halstead, halstead_of, line_hashes, token_text, word_counts


def test_cpp_worked_out_by_hand():
    # operators: if ( > ) { = + ; } return ;      -> if 1, ( 1, > 1, { 1, = 1, + 1, ; 2, return 1
    # operands:  a b a a 1 a                      -> a 4, b 1, 1 1
    assert halstead(b"if (a > b) { a = a + 1; } return a;  // ignored", "cpp") == Halstead(8, 3, 9, 6)


def test_python_worked_out_by_hand():
    # operators: def ( ) : return + *   -> def, (, :, return, +, *   ; operands: f x x 2 x
    source = b'def f(x):\n    """Ignored."""\n    return x + 2 * x  # ignored\n'
    assert halstead(source, "python") == Halstead(6, 3, 6, 5)


@pytest.mark.parametrize(
    ("source", "counts"),
    [
        (b"", Halstead()),
        (b"a->*b <<= c;", Halstead(3, 3, 3, 3)),
        (b"x = 1.5e-3 + .5 - 10.;", Halstead(4, 4, 4, 4)),
        (b"p1.x - 1'000;", Halstead(3, 3, 3, 3)),
        (b'f("a b", \'c\', L"d");', Halstead(3, 4, 4, 4)),
        (b'R"(a\nb)" "c" /* d */ "c"', Halstead(0, 2, 0, 3)),
        (b"a[b(c{d})]", Halstead(3, 4, 3, 4)),
        (b"#include <a/b.h>\nint const x;", Halstead(2, 3, 2, 3)),
    ],
)
def test_cpp_tokens(source, counts):
    assert halstead(source, "cpp") == counts


@pytest.mark.parametrize(
    ("source", "counts"),
    [
        (b"x **= y // z\n", Halstead(2, 3, 2, 3)),
        (b"x = '''a\nb''' + 'c'\n", Halstead(2, 3, 2, 3)),
        (b"(x := 1) if a is not None else b[1:]\n", Halstead(8, 5, 8, 6)),
    ],
)
def test_python_tokens(source, counts):
    assert halstead(source, "python") == counts


def test_a_part_of_a_file():
    source = b"int a; int f() { return a; } int b;"
    text = token_text(blank_comments(source, "cpp"), "cpp")
    start, end = source.index(b"{"), source.index(b"}") + 1
    words = word_counts(text, start, end)
    assert words == {b"return": 1, b"a": 1}
    assert halstead_of(text, words, start, end) == Halstead(3, 1, 3, 1)


def test_lines_that_differ_in_space_and_comments_have_one_hash():
    hashes, numbers = line_hashes(b"int a = 1;\n\n  // x\n\tint  a=1 ; // y\n/* z\n*/ b;\n", "cpp")
    assert numbers == (1, 4, 6)
    assert hashes == (crc32(b"inta=1;"), crc32(b"inta=1;"), crc32(b"b;"))


def test_lines_of_strings_are_told_apart():
    hashes, numbers = line_hashes(b'f("// a");\nf("// b");\ng(R"(\n// c)");\n', "cpp")
    assert numbers == (1, 2, 3, 4)
    assert len(set(hashes)) == 4


def test_python_lines():
    hashes, numbers = line_hashes(b'"""Doc.\n\ntext\n"""\nx = 1 # c\ny = """a\nb"""\n', "python")
    assert numbers == (5, 6, 7)
    assert hashes[0] == crc32(b"x=1")
