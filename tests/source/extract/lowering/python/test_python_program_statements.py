"""Statements of Python, one by one."""

import pytest

from roslens.source.extract.ir.program import Literal
from roslens.source.extract.ir.program_text import program_text
from roslens.source.extract.lowering.python.python_program import program_of_python


def text_of(written: str) -> list[str]:
    return program_text(program_of_python(written.encode())).splitlines()


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("'text'\na\n1\nf", []),
        ("a = b = f()", ["a = f()", "b = a"]),
        ("a, b = f(), 1", ["a = f()", "b = 1"]),
        ("a, b = b, a", ["[a, b] = [b, a]"]),
        ("a, b = f()", ["[a, b] = f()"]),
        ("self.a, self.b = self.x, self.y", ["self->a = self->x", "self->b = self->y"]),
        ("a: int", ["a: int"]),
        ("a: List[int] = f()", ["a: List[int] = f()"]),
        ("a: A[\n  b,\n  c\n ] = f()", ["a: A[b, c] = f()"]),
        ("a -= 1", ["a = (a - 1)"]),
        ("a |= f()", ["a = (a | f())"]),
        ("a ^= f()", ["f()", "a = `a ^= f()`"]),
        ("a[0] = 1", ["a[0] = 1"]),
        ("if a: pass", []),
        ("if f(): pass", ["if f():"]),
        ("for a in b: f(a)\nelse: g()", ["for a in b:", "  f(a)", "g()"]),
        ("while a: f()", ["while a:", "  f()"]),
        ("try: f()\nfinally: g()", ["if `no exception`:", "  f()", "g()"]),
        ("raise f(x) from y", ["f(x)"]),
        ("assert f(x), g()", ["f(x)", "g()"]),
        ("with f(): g()", ["f()", "g()"]),
        ("with (f() as a, b): g()", ["a = f()", "g()"]),
        ("del a\npass", []),
        ("del a[f()]", ["a->pop(f())"]),
        ("type X = int", []),
        ("match f():\n case 1 | A.B: g()\n case x if x: h()\n case _: i()",
         ["#1 = f()", "if ((#1 == 1) or (#1 == A->B)):", "  g()", "else:", "  x = #1", "  if x:", "    h()", "  else:",
          "    i()"]),
        ("match f()[0]:\n case P(x=1): g()", ["#1 = f()[0]", "if `P(x=1)`:", "  g()"]),
        ("match a:\n case P(x=1): g()", ["if `P(x=1)`:", "  g()"]),
        ("@f(1)\nclass A: pass", ["f(1)"]),
    ],
)  # fmt: skip
def test_statement(written, expected):
    text = text_of(written)
    found = text[text.index("body") + 1 :] if "body" in text else []
    assert found == [f"  {line}" for line in expected]


def test_imports():
    program = program_of_python(
        b"import a.b\nimport a.b as c\nfrom . import d\nfrom ..e import f as g\nfrom h import *\n"
        b"from i import (j,\n k)\ndef l():\n    from m import d\n"
    )
    assert program.imports == {
        "a": "a", "c": "a.b", "d": ".d", "g": "..e.f", "j": "i.j", "k": "i.k",
    }  # fmt: skip
    assert program.using == ("h",)
    assert program.includes == (("a.b", 1), ("a.b", 2), (".", 3), ("..e", 4), ("h", 5), ("i", 6), ("m", 9))


def test_a_function_in_a_function_is_assigned_where_it_is_defined():
    assert text_of("def f():\n    @d\n    def g(a): pass\n    h(g)") == [
        "function f()",
        "  g = lambda#1",
        "  h(g)",
        "@d",
        "function f.g(a)",
    ]


def test_the_object_of_a_method_is_self():
    assert text_of("class A:\n  def f(this, a): g(this.b, lambda: this)\n  def __new__(c): return c()") == [
        "class A",
        "function A.f(a) of A",
        "  g(self->b, lambda#1)",
        "function#1 A.f.lambda()",
        "  return self",
        "function A.__new__() of A",
        "  return cls()",
    ]


def test_body_of_a_class():
    assert text_of("class A(B, c.D, metaclass=M):\n  x: int = 1\n  y: str\n  if z:\n    f()\n  w = [i for i in v]") == [
        "class A(B, c.D)",
        "  x: int = 1",
        "  y: str",
        "  w = #1",
        "body",
        "  if z:",
        "    f()",
        "  #1 = []",
        "  for i#1 in v:",
        "    #1 += [i#1]",
    ]


def test_calls_among_the_bases_of_a_class():
    assert text_of("class A(f(), metaclass=g()): pass") == ["class A(f)", "body", "  f()", "  g()"]


def test_a_class_in_a_function():
    assert text_of("def f():\n  class A:\n    def g(self): pass\n  return A()")[:3] == [
        "class f.A",
        "function f()",
        "  return A()",
    ]


def test_lines():
    program = program_of_python(b"\n@d\ndef f():\n    x = 1\n    return x\nclass A:\n    y = 2\n")
    function, one = program.functions[0], program.classes[0]
    assert (function.line, [statement.line for statement in function.body]) == (3, [4, 5])
    assert (one.line, one.fields[0].line, one.fields[0].value) == (6, 7, Literal(2))


def test_arms_nest():
    assert text_of("if a: f()\nelif g(): pass\nelif c: h()\nelse: i()")[1:] == [
        "  if a:",
        "    f()",
        "  else:",
        "    if g():",
        "    else:",
        "      if c:",
        "        h()",
        "      else:",
        "        i()",
    ]
