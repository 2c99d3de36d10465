import pytest

from roslens.source.extract.ir.program import Field, Literal, Parameter
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("", []),
        ("void", []),
        ("int", [Parameter("", "int")]),
        ("const A & a, B * b", [Parameter("a", "const A&"), Parameter("b", "B*")]),
        ("A && a = {}, int n = 3", [("a", "A&&"), Parameter("n", "int", Literal(3))]),
        ("int a[3], ...", [Parameter("a", "int[3]")]),
        ("Args &&... args", [Parameter("args", "Args&&...")]),
        ("void (*callback)(int)", [Parameter("callback", "void(*)()")]),
        ("std::function<void(const A &)> f", [Parameter("f", "std::function<void(const A&)>")]),
        ("[[maybe_unused]] int x", [Parameter("x", "int")]),
    ],
)
def test_parameters(written: str, expected: list[Parameter | tuple[str, str]]) -> None:
    for _ in range(2):
        (function,) = program_of_cpp(f"void f({written}) {{ }}".encode(), MACROS).functions
        found = [
            (one.name, one.type) if isinstance(wanted, tuple) else one
            for one, wanted in zip(function.parameters, expected, strict=True)
        ]
        assert found == expected


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("int a;", [Field("a", "int", None, 2)]),
        ("void f(int a = 3) const override;", []),
        ("virtual void f() = 0;", []),
        ("int f(), a;", [Field("a", "int", None, 2)]),
        ("int a, f();", [Field("a", "int", None, 2)]),
        ("int (*a)(int) = 0;", [("a", "int(*)()")]),
        ("static const int a = 3, *b;", [Field("a", "const int", Literal(3), 2), ("b", "const int*")]),
        ("const int c[2], d;", [("c", "const int[2]"), ("d", "const int")]),
        ("std::map<int, A> a_;", [Field("a_", "std::map<int,A>", None, 2)]),
        ("A * a_{nullptr};", [Field("a_", "A*", Literal(None), 2)]),
        ("A * a_{};", [Field("a_", "A*", Literal(None), 2)]),
        ("unsigned a : 3;", [("a", "unsigned")]),
        ("void (*f)(int);", [("f", "void(*)()")]),
        ("std::function<void()> f;", [("f", "std::function<void()>")]),
        ("void f();", []),
        ("A & operator=(const A &) = delete;", []),
        ("virtual A * f(int x) const = 0;", []),
        ("friend class B;", []),
        ("using A = B;", []),
        ("class Inner;", []),
    ],
)  # fmt: skip
def test_fields(written: str, expected: list[Field | tuple[str, str]]) -> None:
    found = program_of_cpp(f"class C {{\n{written}\n}};".encode(), MACROS).classes[0].fields
    assert [
        (one.name, one.type) if isinstance(wanted, tuple) else one for one, wanted in zip(found, expected, strict=True)
    ] == expected


def test_names_of_template_parameters() -> None:
    source = b"template <typename T, class... U, int N = 3, template <typename> class V> void f(T t) { }"
    assert program_of_cpp(source, MACROS).functions[0].templates == ("T", "U", "N", "V")
