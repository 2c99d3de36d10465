"""What is tried for files that do not parse keeps every byte's place."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.syntax.cpp_repair import first_arms, with_parameter_types


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
