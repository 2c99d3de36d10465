"""Types of values as rcl tells them: the tables are what nodes of rclpy said that were given these texts."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.documents.yaml_tree import read_tree
from roslens.source.extract.parameters.ros2_values import (
    is_mixed,
    type_in_file,
    type_in_launch,
    type_in_rcl,
    type_of_list,
    type_on_line,
    type_when_written,
)

PLAIN = {
    "bool": "true True TRUE false False FALSE yes Yes YES no No NO on On ON off Off OFF y Y n N",
    "int": "1 -1 +1 0x1F 0X1f 017 00 -0 9223372036854775807 -9223372036854775808",
    "double": "1e-3 1E3 1e3 .5 5. -.5 +.5 1.0 1. 1.5e3 .inf -.inf +.inf .Inf .INF .nan .NaN inf Inf nan NaN infinity "
    "9223372036854775808 08 0x1p3",
    "string": "0o17 0b11 1_000 ~ null 1.0f 1,5 12:30 2001-01-01 . 1e 0x 1e400 0.0.1 on_x tRue yEs",
}


def in_file(written):
    root = read_tree(f"x: {written}".encode(), "a.yaml").root
    return root.nodes["x"]


@pytest.mark.parametrize(("kind", "text"), [(kind, text) for kind, texts in PLAIN.items() for text in texts.split()])
def test_plain_texts(kind, text):
    assert type_in_rcl(text) == type_in_file(in_file(text)) == type_on_line(text) == kind


@pytest.mark.parametrize(
    ("written", "kind"),
    [
        ("''", "string"),
        ("'1'", "string"),
        ('"true"', "string"),
        ("a b", "string"),
        ("[1, 2]", "int_array"),
        ("[yes, true]", "bool_array"),
        ("[.5, 1e-3]", "double_array"),
        ("['1', '2']", "string_array"),
        ("[~, a]", "string_array"),
        ("[]", "list"),
        ("[[1, 2]]", "list"),
        ("{}", "map"),
    ],
)
def test_values_of_files(written, kind):
    node = in_file(written)
    assert (type_in_file(node), is_mixed(node)) == (kind, False)


@pytest.mark.parametrize("written", ["[1, 2.0]", "[1.0, 2]", "[a, 1]", "[true, 1]", "['1', 2]", "[1.0, a]"])
def test_lists_that_rcl_refuses(written):
    node = in_file(written)
    assert (type_in_file(node), is_mixed(node)) == ("list", True)


@pytest.mark.parametrize(
    ("text", "kind"),
    [
        ("true", "bool"),
        ("5", "int"),
        ("1_000", "int"),
        ("0b11", "int"),
        ("1.5", "double"),
        # Text to PyYAML, which it writes without quotes; a double to rcl then.
        ("1e-3", "double"),
        ("y", "bool"),
        ("'5'", "string"),
        ("", "string"),
        ("[1, 2]", "int_array"),
        ("[a, b]", "string_array"),
        ("[", ""),
        ("~", ""),
        ("2001-01-01", ""),
    ],
)
def test_texts_in_launch_files(text, kind):
    assert type_in_launch(text) == kind


@pytest.mark.parametrize(
    ("types", "kind"),
    [
        (["int", "int"], "int_array"),
        (["int", "double"], "double_array"),
        (["int", "string"], "string_array"),
        ([], "list"),
        (["int", ""], "list"),
    ],
)
def test_lists_in_launch_files_of_python(types, kind):
    assert type_of_list(types) == kind


@pytest.mark.parametrize(
    ("text", "numbers", "kind"),
    [
        ("True", False, "bool"),
        ("5", True, "int"),
        ("5.5", True, "double"),
        ("5", False, "string"),
        ("1e3", True, "double"),
        ("a.b", True, "string"),
        ("yes", False, "string"),
        ("", True, "string"),
    ],
)
def test_texts_that_are_put_into_files(text, numbers, kind):
    assert type_when_written(text, numbers=numbers) == kind


@given(st.text(max_size=20))
def test_any_text_has_a_type(text):
    assert type_in_rcl(text) in ("bool", "int", "double", "string")
    assert type_in_launch(text) is not None
    assert type_on_line(text) is not None
    assert type_when_written(text, numbers=True)
