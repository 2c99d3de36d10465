import pytest

from roslens.source.extract.ir.program import Name, Sequence
from roslens.source.extract.ir.program_text import program_text
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.lowering.cpp.cpp_variables import target_of
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
        ("int a = 1, *b = nullptr, c;", ["a: int = 1", "b: int* = null", "c: int"]),
        ("static std::string a;", ["a: std::string"]),
        ("A a(b);", ["a: A = A(b)"]),
        ("A a(b, c::d);", ["a: A = A(b, c.d)"]),
        ("A a();", []),
        ("A a(B b);", []),
        ("A * a(b);", []),
        ("A * a{b};", ["a: A* = b"]),
        ("A & a{b};", ["a: A& = b"]),
        ("auto a{b};", ["a = b"]),
        ("A a(b());", ["a: A = A(b())"]),
        ("A a(b::c(d), e<f>(g(h)), i[1]);", ["a: A = A(b.c(d), e<f>(g(h)), i[1])"]),
        ("A a(B (*c)(int));", []),
        ('const char * a[] = {"x"};', ['a: const char*[] = ["x"]']),
        ("A a = {1, 2};", ["a: A = [1, 2]"]),
        ("void (*f)(int) = g;", ["f: void(*)() = g"]),
    ],
)
def test_variables(written: str, expected: list[str]) -> None:
    assert body(written) == expected


def test_names_that_a_declarator_declares() -> None:
    assert target_of(b"* a", "n.") == Name("n.a")
    assert target_of(b"& [a, b]") == Sequence((Name("a"), Name("b")))
    assert target_of(b"*") is None
