"""Facts of C and C++, construct by construct: each folder has a source and the facts worked out by hand."""

import sys
from pathlib import Path

import pytest
from pace import soon

from roslens.source.settings import MacroSettings
from roslens.source.syntax.cpp import parse_cpp
from roslens.source.syntax.macro.macros import load_macros

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

FIXTURES = Path(__file__).parents[2] / "fixtures" / "syntax" / "cpp"
CONSTRUCTS = sorted(folder for folder in FIXTURES.iterdir() if folder.is_dir())
MACROS = load_macros()
FUNCTION_KEYS = (
    "name", "qualified_name", "class_name", "signature", "parameters", "line", "end_line", "access", "static",
    "virtual", "counts", "lambda_counts", "alternative_counts", "eloc", "types", "parameter_types", "calls",
    "approximate",
)  # fmt: skip
CLASS_KEYS = ("kind", "qualified_name", "line", "end_line", "bases", "friends", "types", "approximate")


def facts_of(text, macros=MACROS):
    return parse_cpp(text.encode() if isinstance(text, str) else text, macros)


def event_text(event):
    """Write an event as ``if 0``; what stands in a condition ends with ``?``, in an alternative with ``@``."""
    return f"{event.role} {event.depth}{'?' * (event.part == 'condition')}{'@' * event.alternative}"


def field_text(field):
    words = [field.access, "static" * field.static, field.name, *field.types]
    return " ".join(filter(None, words))


def method_text(method):
    """Write a method as ``public virtual run(int)``; a body in the class is ``{}``."""
    words = [
        str(method.line),
        method.access,
        "static" * method.static,
        "virtual" * method.virtual,
        f"{method.name}({method.signature})",
        "{}" * method.defined_here,
    ]
    return " ".join(filter(None, words))


def plain(value):
    return list(value) if isinstance(value, tuple) else value


def found_in(folder):
    facts = facts_of(next(folder.glob("source.*")).read_bytes())
    functions = [
        {key: plain(getattr(one, key)) for key in FUNCTION_KEYS} | {"control": [event_text(e) for e in one.control]}
        for one in facts.functions
    ]
    classes = [
        {key: plain(getattr(one, key)) for key in CLASS_KEYS}
        | {"fields": [field_text(f) for f in one.fields], "methods": [method_text(m) for m in one.methods]}
        for one in facts.classes
    ]
    return {
        "faults": len(facts.faults),
        "top_level": facts.top_level,
        "includes": [name for name, _ in facts.includes],
        "function": functions,
        "class": classes,
    }


def without_defaults(table):
    """Leave out what is empty, as the expected facts do."""
    if isinstance(table, list):
        return [without_defaults(one) for one in table]
    if isinstance(table, dict):
        return {key: without_defaults(value) for key, value in table.items() if value}
    return table


@pytest.mark.parametrize("folder", CONSTRUCTS, ids=lambda folder: folder.name)
def test_construct(folder):
    expected = tomllib.loads((folder / "expected.toml").read_text("utf-8"))
    assert without_defaults(found_in(folder)) == expected


def only_function(text):
    (function,) = facts_of(text).functions
    return function


@pytest.mark.parametrize(
    ("parameters", "number"),
    [
        ("", 0), ("void", 0), ("int", 1), ("int a, int b", 2), ("int a = f(1, 2)", 1), ("...", 1),
        ("const char * f, ...", 2), ("std::map<int, int> m", 1), ("void (*f)(int, int)", 1),
        ("int a[3], int (&b)[2]", 2),
        ("std::array<int, 3> a = {1, 2, 3}", 1), ("auto && a", 1), ("const void * p", 1),
    ],
)  # fmt: skip
def test_parameters(parameters, number):
    assert only_function(f"int f({parameters}) {{ return 0; }}").parameters == number


@pytest.mark.parametrize(
    ("header", "name", "qualified_name", "class_name"),
    [
        ("int f()", "f", "f", ""),
        ("int A::f()", "f", "A::f", "A"),
        ("int ::A::B::f() const", "f", "A::B::f", "A::B"),
        ("template<class T> T A<T>::B<int>::f()", "f", "A::B::f", "A::B"),
        ("A::A(int) : a{1}, b(2), C<int>(3)", "A", "A::A", "A"),
        ("A::~A() noexcept", "~A", "A::~A", "A"),
        ("A::operator bool() const", "operator bool", "A::operator bool", "A"),
        ("A & A::operator=(A && other) noexcept(true)", "operator=", "A::operator=", "A"),
        ("void A::operator()(int) const &", "operator()", "A::operator()", "A"),
        ("bool operator < (A a, A b)", "operator<", "operator<", ""),
        ("auto f() -> std::vector<int>", "f", "f", ""),
        ("[[nodiscard]] constexpr int f() noexcept", "f", "f", ""),
        ("MY_PUBLIC int f()", "f", "f", ""),
        ("__attribute__((noinline)) int f()", "f", "f", ""),
        ('extern "C" int f()', "f", "f", ""),
        ("int (*f())(int)", "f", "f", ""),
        ("TEST(Suite, case_of_it)", "TEST(Suite,case_of_it)", "TEST(Suite,case_of_it)", ""),
    ],
)  # fmt: skip
def test_names(header, name, qualified_name, class_name):
    function = only_function(header + " { work(); }")
    assert (function.name, function.qualified_name, function.class_name) == (name, qualified_name, class_name)


@pytest.mark.parametrize(
    "source",
    ["int f();", "struct A { A() = default; };", "A::A() = default;", "void f() = delete;", "#define F() { }",
     "int a = 3;", "using F = int(int);", "struct S;", "enum class E { a, b };", "// int f() { }",
     'char * s = "f() {}";'],
)  # fmt: skip
def test_no_function(source):
    facts = facts_of(source)
    assert (facts.functions, facts.faults) == ((), ())


def test_positions():
    facts = facts_of("int a;\n\n  int f(int a) {\n    return a;\n  } int g() { return 1; }\n")
    assert [(f.name, f.line, f.column, f.end_line) for f in facts.functions] == [("f", 3, 3, 5), ("g", 5, 5, 5)]
    assert facts.functions[0].lines.physical == 3


def test_a_fault_marks_only_the_function_it_stands_in():
    facts = facts_of("int good() { return 1; }\nint bad() { x = = @; }\nint fine() { return 2; }\n")
    assert [(f.name, f.approximate) for f in facts.functions] == [("good", False), ("bad", True), ("fine", False)]
    assert [fault.line for fault in facts.faults][:1] == [2]
    assert all(fault.text for fault in facts.faults)


def test_what_is_inside_local_classes_is_not_part_of_the_function():
    outer, inner = facts_of(
        "int f() { struct L { int g() { if (a) return h(); return 1; } int x = k(); }; return 2; }"
    ).functions
    assert (outer.name, outer.counts) == ("f", {"return": 1, "statement": 1})
    assert inner.counts == {"if": 1, "return": 2, "call": 1, "statement": 2}


def test_identifiers_are_those_of_members():
    member, free = facts_of(
        "struct A { int f() { return x_ + y(1) + sizeof(int); } };\nint f() { return x; }"
    ).functions
    assert (member.identifiers, free.identifiers) == (("x_", "y"), ())


def test_includes():
    assert facts_of('#include <a/b.h>\n\n#include "c.hpp"\n').includes == (("<a/b.h>", 1), ('"c.hpp"', 3))


def test_macros_of_a_project():
    source = "MAKE_THING(Widget)\nvoid f() NEVER_FAILS { work(); }\nint g() { return 1; }\n"
    macros = load_macros(MacroSettings(blank=("NEVER_FAILS",), statement=("MAKE_[A-Z]+",)))
    facts = facts_of(source, macros)
    assert ([f.name for f in facts.functions], facts.faults) == (["f", "g"], ())


DEEP = 10_000
HOSTILE = {
    "empty": b"",
    "only_nul": b"\0" * 1000,
    "nul_inside": b"int f() { re\0turn 1; }\nint g() { return 2; }\n",
    "byte_order_mark": b"\xef\xbb\xbfint f() { return 1; }\n",
    "utf_16": "int f() { return 1; }\n".encode("utf-16"),
    "latin_1": b"// \xe4\xf6\xfc\nint f() { return '\xe4'; }\n",
    "carriage_returns": b"int f()\r{\r  return 1;\r}\r",
    "parentheses": b"int f() { return " + b"(" * DEEP + b"1" + b")" * DEEP + b"; }",
    "parentheses_not_closed": b"int f() { return " + b"(" * DEEP,
    "braces": b"void f() " + b"{" * DEEP + b"}" * DEEP,
    "braces_not_closed": b"void f() " + b"{" * DEEP,
    "only_closing": b"}" * DEEP + b"int f() { return 1; }",
    "templates": b"void f(" + b"a<" * DEEP + b"int" + b">" * DEEP + b" x) { }",
    "templates_not_closed": b"void f(" + b"a<" * DEEP,
    "conditions": b"void f() {" + b"\n#if A\n" * DEEP + b"\n#endif\n" * DEEP + b"}",
    "conditions_not_closed": b"void f() {" + b"\n#if A\n" * DEEP,
    "only_else": b"\n#else\n" * DEEP,
    "ifs": b"void f() { " + b"if (a) { " * DEEP + b"}" * DEEP + b"}",
    "else_ifs": b"void f() { " + b"if (a) { } else " * DEEP + b"{ } }",
    "lambdas": b"void f() { " + b"[] { " * 2000 + b"}; " * 2000 + b"}",
    "classes": b"class A { " * 500 + b"}; " * 500,
    "namespaces": b"namespace a { " * 2000 + b"} " * 2000,
    "ands": b"bool f() { return " + b" && ".join([b"a"] * 5000) + b"; }",
    "ternaries": b"int f() { return " + b"a ? b : " * 5000 + b"c; }",
    "string_not_closed": b'int f() { return "abc; }\nint g() { return 1; }\n',
    "comment_not_closed": b"int f() { return 1; }\n/* " + b"abc " * 1000,
    "raw_strings_not_closed": b'R"(' * DEEP,
    "macros_not_closed": b"PLUGINLIB_EXPORT_CLASS(" * DEEP,
    "pointers": b"int " + b"*" * DEEP + b"f() { }",
    "declarators": b"int " + b"(*" * 2000 + b"f" + b")()" * 2000 + b" { }",
    "old_parameters": b"= f(a) int a; " * DEEP,
    "old_parameters_of_nothing": b"f(a" * DEEP + b") int a; " + b"\n" * DEEP + b"= (",
}


@pytest.mark.parametrize("content", HOSTILE.values(), ids=HOSTILE)
def test_hostile_input(content):
    with soon(20):
        facts = facts_of(content)
    last = content.count(b"\n") + 1
    assert all(1 <= f.line <= f.end_line <= last for f in facts.functions)
    assert all(1 <= fault.line <= fault.end_line <= last for fault in facts.faults)


@pytest.mark.parametrize("name", ["byte_order_mark", "latin_1", "carriage_returns", "parentheses", "ifs", "ands"])
def test_odd_but_right_input_has_its_function(name):
    facts = facts_of(HOSTILE[name])
    assert [f.name for f in facts.functions] == ["f"]


def test_line_ends_of_windows_change_nothing():
    source = (FIXTURES / "control" / "source.cpp").read_bytes()
    (plain_,), (windows,) = facts_of(source).functions, facts_of(source.replace(b"\n", b"\r\n")).functions
    for key in (*FUNCTION_KEYS, "control"):
        assert getattr(plain_, key) == getattr(windows, key)


def test_a_long_chain_of_ands_is_counted():
    (function,) = facts_of(HOSTILE["ands"]).functions
    assert function.counts["and"] == 4999
    assert max(event.depth for event in function.control) == 4998


MEGABYTES = 10_000_000
LONG_LINES = {
    "statements": b"int f() { " + b"a = b + 1; " * (MEGABYTES // 11) + b"}",
    "numbers": b"int a[] = {" + b"100000000, " * (MEGABYTES // 11) + b"1}; int f() { return 1; }",
    "one_word": b"a" * MEGABYTES,
    "one_string": b'int f() { return "' + b"a" * MEGABYTES + b'"; }',
    "underscores": b"_A" * (MEGABYTES // 2),
    "nothing_known": b"@ " * (MEGABYTES // 2),
}


@pytest.mark.heavy
@pytest.mark.parametrize(
    "name", [pytest.param(one, marks=[pytest.mark.nightly] if one == "statements" else []) for one in LONG_LINES]
)
def test_ten_megabytes_on_one_line(name):
    with soon(120):
        facts = facts_of(LONG_LINES[name])
    assert (facts.lines.physical, facts.lines.code) == (1, 1)
    assert all(function.end_line == 1 for function in facts.functions)


def test_a_constructor_in_capitals_keeps_its_parameters():
    facts = facts_of(b"class PID { PID(double p, double i) : p_(p) { go(); } explicit PID(int a); double p_; };")
    (function,) = facts.functions
    assert (function.name, function.signature, function.parameters) == ("PID", "double, double", 2)
    assert [(one.name, one.signature) for one in facts.classes[0].methods] == [
        ("PID", "double, double"),
        ("PID", "int"),
    ]


def test_a_test_in_a_class_is_a_test():
    (function,) = facts_of(b"class A { TEST_F(Suite, Name) { go(); } };").functions
    assert function.name == "TEST_F(Suite,Name)"


@pytest.mark.parametrize(
    ("member", "virtual"),
    [
        ("virtual void run(){};", True),
        ("void run() const noexcept { /* nothing */ };", False),
        ("int * run() override {};", True),
        ("auto run() -> int {};", False),
    ],
)
def test_an_empty_body_with_a_semicolon_behind_it(member, virtual):
    facts = facts_of(f"class A {{ {member} int value_{{}}; int (*call_)(int){{}}; }};".encode())
    (function,) = facts.functions
    assert (function.name, function.class_name, function.virtual, function.counts) == ("run", "A", virtual, {})
    (method,) = facts.classes[0].methods
    assert method.defined_here
    assert [one.name for one in facts.classes[0].fields] == ["value_", "call_"]
