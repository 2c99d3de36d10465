import math

import pytest

from roslens.source.extract.parameters.ros1_values import angle, converted, type_in_yaml, type_of_value


@pytest.mark.parametrize(
    ("text", "value"),
    [("1", 1), ("1.5", 1.5), ("True", True), ("x", "x"), ("1e5", "1e5"), ("1.e5", 1e5), ("1_000", "1_000"),
     ("0x10", "0x10"), (" 7", 7), ("yes", "yes"), ("inf", "inf"), (".5", 0.5), ("1.2.3", "1.2.3"), ("", "")],
)  # fmt: skip
def test_values_of_a_launch_file(text, value):
    assert converted(text) == value
    assert type(converted(text)) is type(value)


@pytest.mark.parametrize(
    ("text", "kind", "type_"),
    [("1", "auto", "int"), ("1", "double", "double"), ("1", "str", "string"), ("1e5", "auto", "string"),
     ("TRUE", "auto", "bool"), ("1", "bool", "bool"), ("2.5", "auto", "double"), ("x", "string", "string")],
)  # fmt: skip
def test_types_of_a_launch_file(text, kind, type_):
    assert type_of_value(text, kind) == type_


@pytest.mark.parametrize(("text", "kind"), [("x", "int"), ("2.5", "int"), ("yes", "bool"), ("1", "float")])
def test_what_roslaunch_refuses(text, kind):
    with pytest.raises(ValueError, match=r"is not a type|is not of the type"):
        type_of_value(text, kind)


@pytest.mark.parametrize(
    ("text", "type_"),
    [("1e5", "string"), ("1.0e5", "string"), ("1.0e+5", "double"), ("017", "int"), ("0o17", "string"),
     ("1_000", "int"), ("12:30:45", "int"), ("nan", "string"), (".nan", "double"), ("yes", "bool"), ("y", "string"),
     ("~", ""), ("deg(90)", "double"), ("rad(2*pi)", "double"), ("deg(x)", "string"), ("x", "string")],
)  # fmt: skip
def test_types_in_files_of_parameters(text, type_):
    assert type_in_yaml(text) == type_


def test_angles_are_in_radians():
    assert angle("deg(180)") == pytest.approx(math.pi)
    assert angle("rad(pi/2)") == pytest.approx(math.pi / 2)
    assert angle("degree") is None
