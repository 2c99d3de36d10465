import pytest

from roslens.source.extract.ir.program import Assign, Lambda
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.syntax.macro.macros import load_macros


@pytest.mark.parametrize(
    ("captures", "holds"),
    [
        ("", ()),
        ("this", ()),
        ("&", ()),
        ("&a, this", ()),
        ("a, &b, c", ("a", "c")),
        ("=", ("=",)),
        ("=, &b, this", ("=", "b")),
        ("&, a", ("a",)),
        ("a = b + 1, &c", ("=", "c")),
        ("&a = b", ()),
    ],
)
def test_what_a_lambda_has_copies_of(captures: str, holds: tuple[str, ...]):
    source = f"void f() {{ auto make = [{captures}]() {{ return create_publisher<A>(a); }}; }}"
    statement = program_of_cpp(source.encode(), load_macros()).functions[0].body[0]
    assert isinstance(statement, Assign)
    assert isinstance(statement.value, Lambda)
    assert statement.value.holds == holds


def test_of_one_that_may_change_its_copies_nothing_is_said():
    source = b"void f() { auto make = [a]() mutable { return create_publisher<A>(a); }; }"
    statement = program_of_cpp(source, load_macros()).functions[0].body[0]
    assert isinstance(statement, Assign)
    assert statement.value == Lambda(1)
