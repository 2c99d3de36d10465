"""What is tried for files that do not parse keeps every byte's place."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.syntax.cpp_repair import first_arms, repaired, with_parameter_types
from roslens.source.syntax.macro.macros import load_macros
from roslens.source.syntax.query.cpp_query import parse_tree


@pytest.mark.parametrize(
    ("source", "kept"),
    [
        ("#if A\na\n#else\nb\n#endif\n", "a"),
        ("#if 0\na\n#else\nb\n#endif\n", "b"),
        ("#if A\na\n#elif B\nb\n#else\nc\n#endif\nd\n", "a d"),
        ("#if A\na\n#endif\n", "#if A a #endif"),
        ("#if A\n#if B\nb\n#else\nc\n#endif\n#else\nd\n#endif\n", "b"),
        ("#else\na\n", "#else a"),
    ],
)
def test_first_arms(source, kept):
    found = first_arms(source.encode())
    assert found.decode().split() == kept.split()
    assert (len(found), found.count(b"\n")) == (len(source), source.count("\n"))


@pytest.mark.parametrize(
    ("source", "with_types"),
    [
        ("f(a, b) int a; char *b; {", "f(       int a, char *b) {"),
        ("f(a)\nint a;\n{", "f(  \nint a)\n{"),
        ("if (a) return a; {", "if (a) return a; {"),
        ("f(a) int b; {", "f(a) int b; {"),
        ("f() {", "f() {"),
    ],
)
def test_parameters_of_old_c(source, with_types):
    found = with_parameter_types(source.encode()).decode()
    assert found.split() == with_types.split()
    assert len(found) == len(source)


@given(
    st.lists(st.sampled_from(["#if A\n", "#else\n", "#elif B\n", "#endif\n", "a\n", "f(a) int a; {", "\r\n"])).map(
        "".join
    )
)
def test_places_hold(text):
    content = text.encode()
    for found in (first_arms(content), with_parameter_types(content)):
        assert len(found) == len(content)
        assert [place for place, byte in enumerate(found) if byte == 10] == [
            place for place, byte in enumerate(content) if byte == 10
        ]


def test_a_fault_that_is_all_of_a_file_is_worse_than_several():
    functions = "".join(f"void A::f{one}() {{\n  run({one});\n}}\n" for one in range(60))
    split = "void A::g()\n{\n#if B\n  if (x) {\n#else\n  if (y) {\n#endif\n  run();\n}\n"
    odd = "void A::h() { a b c; d e f; }\n"
    source = f"namespace n\n{{\n{split}{odd}{functions}}}\n".encode()
    found, tree = repaired(source, parse_tree(source), load_macros())
    assert tree.root_node.type == "translation_unit"
    assert [one.type for one in tree.root_node.named_children] == ["namespace_definition"]
    assert (len(found), found.count(b"\n")) == (len(source), source.count(b"\n"))
