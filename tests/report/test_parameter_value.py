import pytest
import yaml

from roslens.report.graph.parameter_value import yaml_value


@pytest.mark.parametrize(
    ("text", "kind", "expected"),
    [
        ("5", "int", 5),
        ("0x10", "int", 16),
        ("1e-3", "double", 0.001),
        ("1e16", "double", 1e16),
        ("True", "bool", True),
        ("5", "string", "5"),
        ('a "b"', "string", 'a "b"'),
        ("[front, left]", "string_array", ["front", "left"]),
        ("['1', '2']", "string_array", ["1", "2"]),
        ("[1, 2]", "double_array", [1.0, 2.0]),
        ("[]", "int_array", []),
    ],
)
def test_a_value_is_read_back_with_its_type(text, kind, expected):
    found = yaml.safe_load(yaml_value(text, kind))
    assert found == expected
    assert type(found) is type(expected)


@pytest.mark.parametrize(
    ("text", "kind"), [("x", "int"), ("maybe", "bool"), ("1, 2", "int_array"), ("5", ""), ("5", "list")]
)
def test_a_text_that_does_not_fit_its_type_has_no_value(text, kind):
    assert yaml_value(text, kind) is None
