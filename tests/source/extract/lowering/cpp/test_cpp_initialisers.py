import pytest

from roslens.source.extract.ir.program_text import program_text
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("a_(1)", "self->a_ = 1"),
        ("a_{1}", "self->a_ = 1"),
        ("a_(1, 2)", "self->a_ = [1, 2]"),
        ("a_()", "self->a_ = []"),
        ("A(1)", "A(1)"),
        ("known(1)", "known(1)"),
        ("other(1)", "self->other = 1"),
        ("rclcpp::Node(1)", "rclcpp.Node(1)"),
        ("Template<T>(1)", "Template<T>(1)"),
        ("Base(std::forward<Args>(args)...)", "Base(`std::forward<Args>(args)...`)"),
        ("MAX(1)", "self->MAX = 1"),
        ("Odd_(1)", "self->Odd_ = 1"),
        ("a_([] { f(); })", "self->a_ = lambda#1"),
    ],
)
def test_initialisers(written: str, expected: str) -> None:
    source = f"struct A : known {{ A() : {written} {{ }} }};"
    lines = program_text(program_of_cpp(source.encode(), MACROS)).splitlines()
    assert lines[2] == f"  init {expected}"
