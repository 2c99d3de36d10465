import pytest
import yaml

from roslens.model.configuration import ConfiguredParameter
from roslens.report.graph.nodl_parameter import nodl_parameter


def read(**more):
    return yaml.safe_load("\n".join(nodl_parameter(ConfiguredParameter("x", **more))))["x"]


def test_everything_that_is_said():
    assert read(
        type="double", default="1", description="how: fast", read_only=True, range="0..2.5", constraints=("a", "b")
    ) == {
        "type": "double",
        "default_value": 1.0,
        "description": "how: fast",
        "read_only": True,
        "additional_constraints": "a; b",
        "validation": {"bounds<>": [0.0, 2.5]},
    }


@pytest.mark.parametrize(
    ("kind", "default", "value"),
    [
        ("string_array", "[front, 'left']", ["front", "left"]),
        ("string_array", "[]", []),
        ("double_array", "[1, 2.5, 1e-7]", [1.0, 2.5, 1e-7]),
        ("int_array", "[1, 0x10]", [1, 16]),
        ("bool_array", "[true, false]", [True, False]),
        ("byte_array", "[1, 2]", [1, 2]),
        ("double", "1e-07", 1e-07),
        ("double", ".5", 0.5),
        ("double", "inf", float("inf")),
        ("int", "0x10", 16),
        ("string", "[a]", "[a]"),
        ("bool", "true", True),
    ],
)
def test_defaults(kind, default, value):
    assert read(type=kind, default=default) == {"type": kind, "default_value": value}


@pytest.mark.parametrize(
    ("kind", "default"), [("int", "a"), ("bool", "5"), ("int_array", "[1, a]"), ("int_array", "1")]
)
def test_a_default_that_does_not_fit_is_left_out(kind, default):
    assert read(type=kind, default=default) == {"type": kind}


@pytest.mark.parametrize(
    ("kind", "range_", "checks"),
    [
        ("int", "1..5", {"bounds<>": [1, 5]}),
        ("double", ">0..", {"gt<>": [0.0]}),
        ("double", "0..<1", {"gt_eq<>": [0.0], "lt<>": [1.0]}),
        ("int", "..5", {"lt_eq<>": [5]}),
    ],
)
def test_ranges(kind, range_, checks):
    assert read(type=kind, range=range_)["validation"] == checks


def test_values_that_are_allowed():
    assert read(type="string", allowed=("a", "b"))["validation"] == {"one_of<>": [["a", "b"]]}
    assert read(type="int", allowed=("1", "2"))["validation"] == {"one_of<>": [[1, 2]]}
    assert read(type="int_array", allowed=("1",)) == {"type": "int_array"}
