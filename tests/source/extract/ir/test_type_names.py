import pytest

from roslens.source.extract.ir.type_names import dotted, type_arguments, type_name


@pytest.mark.parametrize(
    ("written", "name", "inside"),
    [
        ("int", "int", ""),
        ("const std::string &", "std.string", ""),
        ("std::shared_ptr<a::B>", "a.B", ""),
        ("a::B::SharedPtr", "a.B", ""),
        ("a::B<c::D>::SharedPtr", "a.B", "c::D"),
        ("std::unique_ptr<a::B<c::D>>", "a.B", "c::D"),
        ("std::vector<a::B>", "std.vector", "a::B"),
        ("", "", ""),
    ],
)
def test_the_class_of_a_declared_type(written, name, inside):
    assert type_name(written) == (name, inside)


def test_template_arguments_one_by_one():
    assert type_arguments("a::B<c, d>, e, f(g, h)") == ["a::B<c, d>", "e", "f(g, h)"]
    assert type_arguments("") == []


def test_names_with_dots():
    assert dotted("a::B<c::D>::E &") == "a.B.E"
