import pytest

from roslens.source.extract.ir.program_text import program_text
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()


def body(written: str) -> list[str]:
    """Return the lines of a function that is lowered whole."""
    program = program_of_cpp(f"void g() {{ {written} }} // QoS".encode(), MACROS)
    assert not program.incomplete
    return [line[2:] for line in program_text(program).splitlines()[1:]]


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("a = b = c;", ["b = c", "a = b"]),
        ("a <<= 2;", ["a = (a << 2)"]),
        ("a; 1; f; break;", []),
        ("++i; i--;", ["i = (i + 1)", "i = (i - 1)"]),
        ("while (a) { f(); if (b) break; continue; }", ["while a:", "  f()", "  if b:", "    break", "  continue"]),
        ("for (;;) { switch (a) { case 1: f(); break; default: continue; } }",
         ["loop:", "  if (a == 1):", "    f()", "  else:", "    continue"]),
        ("do { f(); } while (g());", ["loop:", "  f()", "  g()"]),
        ("for (;; i += 2) { f(); }", ["loop:", "  f()", "then:", "  i += 2"]),
        ("a << b;", ["(a << b)"]),
        ("c ? f() : g();", ["(c ? f() : g())"]),
        ("if (a) { } else { }", []),
        ("if (a) { } else { f(); }", ["if a:", "else:", "  f()"]),
        ("while (f()) { }", ["while f():"]),
        ("switch (a) { default: f(); }", ["f()"]),
        ("switch (a) { case 1: default: f(); }", ["f()"]),
        ("switch (a) { f(); }", []),
        ("switch (int b = f(); b) { case 1: g(); }", ["b: int = f()", "if (b == 1):", "  g()"]),
        ("for (A a = f(); a; a = h(a)) { g(); }", ["a: A = f()", "while a:", "  g()", "then:", "  a = h(a)"]),
        ("try { f(); } catch (A &) { } catch (...) { g(); }",
         ["if `no exception`:", "  f()", "else:", "  if `catch (A &)`:", "  else:", "    g()"]),
        ("throw;", ["throw()"]),
    ],
)  # fmt: skip
def test_statements(written: str, expected: list[str]) -> None:
    assert body(written) == expected


def test_a_case_without_break_is_followed_by_the_next(node_of, names):
    body = "switch (ask()) { case 1: { {a} } case 2: {b} break; case 3: {c} default: {d} }"
    for one in "abcd":
        body = body.replace(f"{{{one}}}", f'create_publisher<std_msgs::msg::String>("{one}", 1);')
    facts = node_of(body)
    assert {str(one.name): as_written(one.conditions) for one in facts.endpoints} == {
        "a": ("ask() == 1",),
        "b": ("ask() == 1 or ask() == 2",),
        "c": ("not ask() == 1", "not ask() == 2", "ask() == 3"),
        "d": ("not ask() == 1", "not ask() == 2"),
    }
