import pytest

from roslens.source.extract.domain.abstract_value import Named, Obj, Unknown
from roslens.source.extract.domain.parameter_types import (
    ITEM,
    VECTOR,
    array_of_cpp,
    type_of_constant,
    type_of_cpp,
    type_of_value,
)
from roslens.source.extract.domain.typed_list import TypedList
from roslens.source.extract.symbolic.text import Text


@pytest.mark.parametrize(
    ("written", "expected"),
    [
        ("bool", "bool"),
        ("const int &", "int"),
        ("unsigned long", "int"),
        ("std::size_t", "int"),
        ("uint8_t", "int"),
        ("float", "double"),
        ("std::string", "string"),
        ("const char *", "string"),
        ("std::vector<std::string>", "string_array"),
        ("const std::vector<float> &", "double_array"),
        ("std::vector<int>", "int_array"),
        ("std::vector<uint8_t>", "byte_array"),
        ("std::vector<bool>", "bool_array"),
        ("std::vector<Thing>", ""),
        ("std::map<std::string, double>", ""),
        ("ParamType", ""),
        ("", ""),
    ],
)
def test_types_of_cpp(written, expected):
    assert type_of_cpp(written) == expected


def test_items_of_vectors():
    assert (array_of_cpp("std::string"), array_of_cpp("T")) == ("string_array", "")


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("rclcpp.PARAMETER_STRING_ARRAY", "string_array"),
        ("rclcpp.ParameterType.PARAMETER_DOUBLE", "double"),
        ("rcl_interfaces.msg.ParameterType.PARAMETER_BYTE_ARRAY", "byte_array"),
        ("rclcpp.ParameterType.PARAMETER_NOT_SET", ""),
        ("rclpy.Parameter.Type.INTEGER_ARRAY", "int_array"),
        ("rclpy.parameter.Parameter.Type.BOOL", "bool"),
        ("Parameter.Type.INTEGER", "int"),
        ("other.Type.STRING", None),
    ],
)
def test_constants_that_name_a_type(name, expected):
    assert type_of_constant(Named(name)) == expected
    assert type_of_constant(Text.of(name)) is None


@pytest.mark.parametrize(
    ("value", "cpp", "python"),
    [
        (True, "bool", "bool"),
        (1, "int", "int"),
        (1.5, "double", "double"),
        (Text.of("a"), "string", "string"),
        ([Text.of("a"), Unknown("what")], "string_array", "string_array"),
        ([1, 2.5], "double_array", "list"),
        ([], "list", "byte_array"),
        ([[1], [2]], "list", "list"),
        ([Unknown("what")], "list", "list"),
        (TypedList([], "string_array"), "string_array", "string_array"),
        (TypedList([1]), "int_array", "int_array"),
        (Obj(VECTOR, None, {}, None, {ITEM: "double"}), "double_array", "double_array"),
        (None, "", ""),
        (Unknown("what"), "", ""),
    ],
)
def test_types_of_values(value, cpp, python):
    assert (type_of_value(value), type_of_value(value, python=True)) == (cpp, python)
