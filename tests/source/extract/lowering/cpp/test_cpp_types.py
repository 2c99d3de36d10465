import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.lowering.cpp.cpp_types import (
    declared_name,
    declared_type,
    dotted,
    is_primitive,
    name_and_templates,
    split_at_commas,
)


@pytest.mark.parametrize(
    ("written", "name", "templates"),
    [
        (b"f", "f", ()),
        (b"::a :: b", "a.b", ()),
        (b"std::make_shared<a::T>", "std.make_shared", ("a::T",)),
        (b"f<std::map<int, A<B> >, 3>", "f", ("std::map<int,A<B>>", "3")),
        (b"A<T>::create", "A.create", ("T",)),
        (b"A<T>::create<U>", "A.create", ("U",)),
        (b"template f<T>", "f", ("T",)),
        (b"typename A<T>::B", "A.B", ("T",)),
        (b"f<>", "f", ()),
        (b"f<T /* x, y */>", "f", ("T",)),
        (b"operator<", "operator<", ()),
    ],
)
def test_names_with_template_arguments(written: bytes, name: str, templates: tuple[str, ...]) -> None:
    assert name_and_templates(written) == (name, templates)


@pytest.mark.parametrize(
    ("before", "declarator", "type_", "name"),
    [
        (b"int", b"x", "int", "x"),
        (b"static const char * ", b"const kName", "const char*", "kName"),
        (b"const std::string ", b"& name", "const std::string&", "name"),
        (b"constexpr auto ", b"x", "", "x"),
        (b"const auto ", b"& x", "", "x"),
        (b"decltype(a) ", b"x", "", "x"),
        (b"[[maybe_unused]] int ", b"x", "int", "x"),
        (b"std::vector<int> ", b"v[3]", "std::vector<int>[]", "v"),
        (b"struct A ", b"*a", "A*", "a"),
        (b"int // comment\n ", b"x", "int", "x"),
        (b"int ", b"A<T>::x", "int", "A.x"),
        (b"void ", b"(*fp)(int)", "void(*)()", "fp"),
        (b"int ", b"", "int", ""),
    ],
)
def test_declarations(before: bytes, declarator: bytes, type_: str, name: str) -> None:
    assert declared_type(before, declarator).replace("[3]", "[]") in (type_, f"{type_}const")
    assert declared_name(declarator) == name


def test_types_that_are_cast_to() -> None:
    for type_ in (b"int", b"unsigned  long", b"double", b"bool", b"std::size_t", b"uint8_t", b"std::int64_t"):
        assert is_primitive(type_)
    for type_ in (b"std::string", b"Int", b"integer", b"int_t", b""):
        assert not is_primitive(type_)


def test_commas_in_brackets_part_nothing() -> None:
    assert split_at_commas("a, b<c, d>, (e, f)") == ["a", " b<c, d>", " (e, f)"]
    assert split_at_commas("") == []
    assert dotted(" a ") == "a"


@given(st.binary(max_size=40), st.binary(max_size=40))
def test_anything_is_read(before: bytes, declarator: bytes) -> None:
    assert isinstance(declared_type(before, declarator), str)
    assert isinstance(declared_name(declarator), str)
    name, templates = name_and_templates(before)
    assert isinstance(name, str)
    assert isinstance(templates, tuple)
    assert "".join(split_at_commas(name)) == name.replace(",", "") or "," in name
