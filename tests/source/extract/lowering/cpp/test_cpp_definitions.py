from roslens.source.extract.ir.program import Function, Program
from roslens.source.extract.ir.program_text import program_text
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()


def lowered(source: str) -> Program:
    return program_of_cpp(source.encode(), MACROS)


def names(source: str) -> list[tuple[str, str]]:
    return [(one.qualified_name, one.class_name) for one in lowered(source).functions]


def test_a_function_is_known_by_its_enclosing_and_its_written_scope() -> None:
    assert names("void f() { }") == [("f", "")]
    assert names("namespace a { void B::f() { } }") == [("a.B.f", "a.B")]
    assert names("namespace a { void a::B::f() { } }") == [("a.B.f", "a.B")]
    assert names("void ::a::B<T>::f() { }") == [("a.B.f", "a.B")]
    assert names("namespace a::b { namespace { struct C { void f() { } }; } }") == [("a.b.C.f", "a.b.C")]
    assert names("A::A() { }") == [("A.A", "A")]
    assert names("A::operator bool() const { }") == [("A.operator bool", "A")]
    assert names("A & operator<<(A & a, B b) { }") == [("operator<<", "")]
    assert names("void (*f(int x))(int) { }")[0][0].endswith("f")


def test_functions_without_a_body_are_none() -> None:
    assert names("struct A { A() = default; A(const A &) = delete; virtual void f() = 0; void g(); }; void h();") == []


def test_defaults_of_declared_parameters_are_kept() -> None:
    program = lowered(
        "struct A { explicit A(int x = 1); void f(B b = {}, C c = C()); void g(int x); }; void h(int y = 2);"
    )
    declared = program.declarations
    assert [one.qualified_name for one in declared] == ["A.A", "A.f", "h"]
    assert all(isinstance(one, Function) and not one.body for one in declared)
    assert [one.class_name for one in declared] == ["A", "A", ""]


def test_an_include_guard_is_no_condition() -> None:
    guarded = "#ifndef A_H\n#define A_H\nconst int x = 1;\n#endif\n"
    assert program_text(lowered(guarded)) == "body\n  x: const int = 1\n"
    assert "#ifdef A_H" in program_text(lowered(guarded.replace("ifndef", "ifdef").replace("#define A_H\n", "")))


def test_names_that_mean_others_belong_to_their_scope() -> None:
    source = """
        using a::b;
        namespace n { using T = a::B<int>; struct C { typedef int U; using Base::Base; }; }
        void f() { using L = long; using namespace x::y; }
        namespace z = a::b;
        typedef struct { int v; } Plain, *Pointer;
        typedef enum { ONE } Number;
    """
    program = lowered(source)
    assert program.imports == {
        "b": "a::b",
        "n.T": "a::B<int>",
        "n.C.U": "int",
        "f.L": "long",
        "z": "a::b",
    }
    assert program.using == ("x.y",)
    assert [one.qualified_name for one in program.classes] == ["n.C", "Plain"]


def test_lambdas_follow_the_function_they_stand_in() -> None:
    program = lowered("void f() { g([] { h([] { }); }, [] { }); } auto x = [] { };")
    assert [one.qualified_name for one in program.functions] == [
        "f",
        "f.lambda",
        "f.lambda.lambda",
        "f.lambda",
        "lambda",
    ]
