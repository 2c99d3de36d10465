"""The names of a Python file that nothing binds."""

import gc
import time

import pytest
import tree_sitter_python
from tree_sitter import Language, Parser

from roslens.source.rules.views.python_names import PythonNames, text_of

PARSER = Parser(Language(tree_sitter_python.language()))


def unbound(text):
    return [text_of(node) for node in PythonNames(PARSER.parse(text.encode()).root_node).unbound()]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("import os, a.b.c\nos.sep, a.b", []),
        ("from a import b as c\nc, b", ["b"]),
        ("def f(a, *b, c=1, d: int = 2, **e): return [a, b, c, d, e, g]", ["g"]),
        ("f = lambda a, b=2, *c: a + b + len(c) + d", ["d"]),
        ("for (i, j), *k in []: i, j, k", []),
        ("with open('a') as f, open('b') as (g, h): f, g, h", []),
        ("try:\n    pass\nexcept ValueError as e:\n    e", []),
        ("[a for a in [1] if a]; a", ["a"]),
        ("{k: v for k, v in b}", ["b"]),
        ("if (n := 1): n", []),
        ("[t for t in [1] if (m := t)]; m", []),
        ("class A:\n    b = 1\n    c = b\n    def d(self): return b", ["b"]),
        ("class A:\n    b = [1]\n    c = [d for d in b]\n    e = [b for d in c for f in b]", ["b", "b"]),
        ("class A:\n    b = [1]\n    c = tuple(f'{d}' for d in b)", []),
        ("def f():\n    global g\n    g = 1\ng", []),
        ("def f():\n    return later\nlater = 1", []),
        ("f'{a} {b!r:>{c}}'", ["a", "b", "c"]),
        ("match a:\n    case [b, *c]: b, c\n    case other: other", ["a"]),
        ("call(keyword=1).attribute", ["call"]),
        ("@deco\ndef f(): pass", ["deco"]),
        ("def f(a=default): pass", ["default"]),
        ("try:\n    unicode\nexcept NameError:\n    pass", []),
        ("def f():\n    a: Nothing = 1\n    return a", []),
        ("def f(a: Nothing): pass", ["Nothing"]),
        ("from __future__ import annotations\ndef f(a: Nothing) -> Neither: pass", []),
        ("from a import *\nanything", []),
        ("exec('a = 1')\na", []),
        ("__file__, __name__, print", []),
    ],
)
def test_a_name_that_is_read_is_bound_somewhere_around_it(text, expected):
    assert unbound(text) == expected


def test_calls_in_a_row_take_no_square_of_their_number():
    def seconds(calls):
        tree = Parser(Language(tree_sitter_python.language())).parse(b"x = a" + b".f()" * calls + b"\n")
        # Whatever else this process holds is collected at moments of its own, which would be counted here.
        gc.disable()
        try:
            begun = time.process_time()
            PythonNames(tree.root_node)
            return time.process_time() - begun
        finally:
            gc.enable()

    few = min(seconds(500) for _ in range(3))
    assert min(seconds(5_000) for _ in range(3)) < 30 * few
