"""Whatever the bytes of a Python file are: its faults are named, the rest is measured, and time stays linear."""

import pytest
from pace import soon

from roslens.source.syntax.facts import Lines, SyntaxFault
from roslens.source.syntax.python import parse_python

BROKEN = b"""\
def good(a):
    if a:
        return 1


def broken(a):
    x = (1 +
    return x


def also_good(b):
    while b:
        b -= 1
"""


def test_a_fault_names_its_place_and_the_rest_is_measured():
    facts = parse_python(BROKEN)
    found = {function.name: function for function in facts.functions}
    assert found["good"].counts == {"if": 1, "return": 1, "statement": 1}
    assert not found["good"].approximate
    assert found["also_good"].counts == {"while": 1, "statement": 1}
    assert not found["also_good"].approximate
    assert found["broken"].approximate
    assert facts.faults
    assert all(6 <= fault.line <= fault.end_line <= 8 for fault in facts.faults)


@pytest.mark.parametrize(
    ("content", "fault"),
    [
        (b"x = 1\n  y = $\n", SyntaxFault(2, 3, 2, "y = $")),
        (b"x = 'abc\n", SyntaxFault(1, 5, 1, "'")),
        (b"\n\n  )\n", SyntaxFault(3, 3, 3, ")")),
        (b"class :\n    pass\n", SyntaxFault(1, 1, 2, "class : pass")),
        (b"x = {1: }\n", SyntaxFault(1, 7, 1, ":")),
        (b"def f(:\n  pass\n", SyntaxFault(1, 7, 1, ") is missing")),
        (b"x = 1\0\n", SyntaxFault(1, 1, 1, "x = 1\\x00")),
        (b"(" * 1000, SyntaxFault(1, 1, 1, "(" * 59 + "…")),
    ],
)
def test_faults(content, fault):
    assert parse_python(content).faults == (fault,)


@pytest.mark.parametrize(
    "content",
    [
        b"\xef\xbb\xbfdef f():\n    return 1\n",
        b"def f():\r\n    return 1\r\n",
        b"def f():\r    return 1\r",
        b"# -*- coding: latin-1 -*-\ndef f():\n    return '\xe9'  # \xff\n",
        b"def f():\n\treturn 1\n\x0c\n",
        b"def f():\n    return 1",
        b"def f(): \\\n  return 1\n",
    ],
)
def test_any_encoding_and_line_end(content):
    facts = parse_python(content)
    assert facts.faults == ()
    assert [function.counts for function in facts.functions] == [{"return": 1, "statement": 1}]


def test_letters_of_another_encoding():
    facts = parse_python("def é(): return ü\n".encode("latin-1"))
    assert facts.faults == ()
    assert [function.name for function in facts.functions] == ["_"]
    assert [function.name for function in parse_python("def é(): return ü\n".encode()).functions] == ["é"]


def test_nothing():
    facts = parse_python(b"")
    assert (facts.lines, facts.functions, facts.classes, facts.top_level, facts.faults) == (Lines(), (), (), {}, ())


PIECES = {
    "parentheses": (b"(", b""),
    "mixed brackets": (b"([{", b""),
    "closed parentheses": (b"(", b"1", b")"),
    "not": (b"not ", b""),
    "stars": (b"*", b""),
    "lambda": (b"lambda: ", b"1"),
    "and": (b"a and ", b"b"),
    "and in parentheses": (b"(a and ", b"b", b")"),
    "and to the left": (b"(", b"a", b" and b)"),
    "ternary": (b"a if b else ", b"c"),
    "ternary to the left": (b"(", b"a", b" if b else c)"),
    "chained calls": (b"", b"a", b".b()"),
    "calls of calls": (b"", b"a", b"()"),
    "nested calls": (b"f(", b"", b")"),
    "comprehensions": (b"[a for b in ", b"c", b"]"),
    "assignments": (b"self.a = ", b"B()"),
    "continuations": (b"\\\n", b"a"),
    "strings": (b"'a' ", b""),
    "open f-strings": (b"f'{", b""),
    "triple quotes": (b'"""', b""),
    "functions": (b"\ndef f(): pass", b""),
    "methods": (b"\n def f(self): self.a = B()", b""),
    "decorators": (b"@a\n", b"def f(): pass"),
    "elif": (b"\nelif a: pass", b""),
    "types": (b"List[", b"int", b"]"),
    "NUL": (b"\0", b""),
}
STARTS = {"methods": b"class A:", "elif": b"if a: pass", "types": b"a: ", "functions": b"", "decorators": b""}


def _repeated(name: str, times: int) -> bytes:
    before, middle, *after = PIECES[name]
    return STARTS.get(name, b"x = ") + before * times + middle + b"".join(after) * times + b"\n"


@pytest.mark.parametrize("name", PIECES)
def test_10_000_of_a_kind(name):
    content = _repeated(name, 10_000)
    with soon(60):
        lines = parse_python(content).lines
    assert lines.physical == content.count(b"\n")


OFTEN_HUGE = ("elif", "strings", "nested calls", "NUL")
"""Kinds of which a megabyte is read with each change, of the others each night."""


@pytest.mark.heavy
@pytest.mark.parametrize(
    "name", [name if name in OFTEN_HUGE else pytest.param(name, marks=pytest.mark.nightly) for name in PIECES]
)
def test_a_megabyte_of_a_kind(name):
    content = _repeated(name, 1_000_000 // sum(map(len, PIECES[name])))
    with soon(200):
        lines = parse_python(content).lines
    assert lines.physical == content.count(b"\n")


def test_functions_nested_too_deep_are_approximate():
    content = b"".join(b" " * depth + b"def f():\n" for depth in range(30)) + b" " * 30 + b"return self.x\n"
    functions = parse_python(content).functions
    assert [function.approximate for function in functions] == [False] * 20 + [True] * 10
    assert functions[-1].lines == Lines(2, 2)
    assert functions[-1].eloc == 1
