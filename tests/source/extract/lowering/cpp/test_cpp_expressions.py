import pytest

from roslens.source.extract.ir.program import Assign, Call
from roslens.source.extract.ir.program_text import expression_text
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()


def value(written: str) -> str:
    program = program_of_cpp(f"auto x = {written};".encode(), MACROS)
    assign = program.body[0]
    assert isinstance(assign, Assign)
    assert assign.value is not None
    return expression_text(assign.value)


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("((x))", "x"),
        ("this->x", "self->x"),
        ("(*this).f()", "self->f()"),
        ("a::b::c", "a.b.c"),
        ("&A::f", "A.f"),
        ("&A<T>::f", "A.f"),
        ("a.Base::f(1)", "a->Base.f(1)"),
        ("a + b + c - d", "((a + b + c) - d)"),
        ("a + (b + c)", "(a + (b + c))"),
        ("a and not b or c", "((a and (not b)) or c)"),
        ("-x", "(- x)"),
        ("a ?: b", "(a ? a : b)"),
        ("a[1, 2]", "a[[1, 2]]"),
        ("std::vector<int>{1, 2}", "std.vector<int>([1, 2])"),
        ("std::vector<int>()", "std.vector<int>([])"),
        ("std::array<int, 2>{1, 2}", "[1, 2]"),
        ('std::map<std::string, int>{{"a", 1}}', '[["a", 1]]'),
        ("Foo{}", "Foo()"),
        ("int{}", "0"),
        ("reinterpret_cast<A *>(b)", "b"),
        ("std::static_pointer_cast<A>(b)", "std.static_pointer_cast<A>(b)"),
        ("new A", "A()"),
        ("new a::A<T>[3]", "a.A<T>()"),
        ("new double[3]", "`new double[3]`"),
        ("f(1)(2)", "f(1)(2)"),
        ("f<T>", "f"),
        ("f /* why */ (/* one */ 1, // two\n 2)", "f(1, 2)"),
        ("obj /* x */ . /* y */ f(1)", "obj->f(1)"),
        ("sizeof(A)", "`sizeof(A)`"),
        ("i++", "`i++`"),
        ("(a = f(1))", "(a = f(1))"),
        ('fmt::format(pattern, "a")', 'fmt.format(pattern, "a")'),
        ('fmt::format("{} {", a)', 'format[a, " {"]'),
        ('fmt::format("{}{}", a)', "format[a, `{}`]"),
        ('fmt::format("plain")', 'format["plain"]'),
        ('"a"s + "b"', '("a" + "b")'),
        ("10_hz", "_hz(10)"),
    ],
)
def test_expressions(written: str, expected: str) -> None:
    assert value(written) == expected


def test_calls_say_where_they_begin_also_where_they_say_the_same() -> None:
    program = program_of_cpp(b"auto x = f(1);\nauto y =  f(1);", MACROS)
    calls = [one.value for one in program.body if isinstance(one, Assign)]
    assert [(one.line, one.column) for one in calls if isinstance(one, Call)] == [(1, 10), (2, 11)]
