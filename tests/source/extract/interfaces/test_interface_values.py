"""Values of constants and defaults."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.interfaces.interface import FieldType
from roslens.source.extract.interfaces.interface_types import MisreadError
from roslens.source.extract.interfaces.interface_values import constant_value, default_value


@pytest.mark.parametrize(
    ("type_", "written", "generation", "expected"),
    [
        ("int8", "-128", 1, -128), ("char", "255", 1, 255), ("byte", "-1", 1, -1), ("bool", "1", 1, True),
        ("bool", "False", 1, False), ("string", " a # b ", 1, "a # b"), ("float32", "1e3", 1, 1000.0),
        ("byte", "255", 2, 255), ("uint8", "0xff", 2, 255), ("bool", "TRUE", 2, True), ("bool", "0", 2, False),
        ("string", "'a'", 2, "a"), ("string", '"a', 2, '"a'), ("wstring", r"'it\'s'", 2, "it's"),
    ],
)  # fmt: skip
def test_constants(type_, written, generation, expected):
    assert constant_value(type_, written, generation) == expected


@pytest.mark.parametrize(
    ("type_", "written", "generation"),
    [
        ("int8", "128", 1), ("byte", "128", 1), ("uint8", "-1", 1), ("uint8", "0xff", 1), ("bool", "yes", 1),
        ("bool", "(" * 5000, 1), ("float64", "", 1), ("int32", "1" * 5000, 1), ("int32", "", 1),
        ("byte", "-1", 2), ("bool", "2", 2), ("string", "'a'b'", 2), ("int64", str(2**63), 2), ("float32", "1,5", 2),
    ],
)  # fmt: skip
def test_no_constants(type_, written, generation):
    with pytest.raises(MisreadError):
        constant_value(type_, written, generation)


@pytest.mark.parametrize(
    ("type_", "written", "expected"),
    [
        (FieldType("int32", "", "unbounded"), "[]", ()),
        (FieldType("int32", "", "unbounded"), "[1, -2]", (1, -2)),
        (FieldType("bool", "", "fixed", 2), "[true, 0]", (True, False)),
        (FieldType("string", "", "unbounded"), "['a, b', \"c\", d]", ("a, b", "c", "d")),
        (FieldType("string", "", "bounded", 2, 3), "['abc']", ("abc",)),
        (FieldType("string"), "a b", "a b"),
    ],
)
def test_defaults(type_, written, expected):
    assert default_value(type_, written) == expected


@pytest.mark.parametrize(
    ("type_", "written"),
    [
        (FieldType("int32", "", "unbounded"), "1"),
        (FieldType("int32", "", "unbounded"), "[a]"),
        (FieldType("int32", "", "fixed", 2), "[1]"),
        (FieldType("int32", "", "bounded", 1), "[1, 2]"),
        (FieldType("string", "", "unbounded"), "['a"),
        (FieldType("string", "", "unbounded", 0, 2), "['abc']"),
        (FieldType("Pose", "m"), "1"),
    ],
)
def test_no_defaults(type_, written):
    with pytest.raises(MisreadError):
        default_value(type_, written)


@given(st.integers(0, 2**64 - 1))
def test_any_number_comes_back(number):
    assert constant_value("uint64", str(number), 2) == number
