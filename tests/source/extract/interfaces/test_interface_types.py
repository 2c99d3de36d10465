"""Types and names in interface files."""

import pytest
from pace import soon

from roslens.source.extract.interfaces.interface import FieldType
from roslens.source.extract.interfaces.interface_types import (
    MisreadError,
    check_constant_name,
    check_field_name,
    field_type,
)


@pytest.mark.parametrize(
    ("written", "generation", "expected"),
    [
        ("int32", 1, ("int32", "", "", 0, 0)),
        ("time[]", 1, ("time", "", "unbounded", 0, 0)),
        ("byte[16]", 1, ("byte", "", "fixed", 16, 0)),
        ("Header", 1, ("Header", "std_msgs", "", 0, 0)),
        ("Header[]", 1, ("Header", "m", "unbounded", 0, 0)),
        ("Pose[2]", 1, ("Pose", "m", "fixed", 2, 0)),
        ("a/pose_2", 1, ("pose_2", "a", "", 0, 0)),
        ("wstring", 2, ("wstring", "", "", 0, 0)),
        ("wstring<=7[<=3]", 2, ("wstring", "", "bounded", 3, 7)),
        ("Header", 2, ("Header", "m", "", 0, 0)),
        ("a/Pose[<=2]", 2, ("Pose", "a", "bounded", 2, 0)),
        ("a/Pose[]", 2, ("Pose", "a", "unbounded", 0, 0)),
    ],
)
def test_types(written, generation, expected):
    assert field_type(written, "m", generation) == FieldType(*expected, written)


@pytest.mark.parametrize(
    ("written", "generation"),
    [
        ("int32[", 1), ("int32[<=3]", 1), ("1a", 1), ("a//b", 1), ("a/b/c", 1), ("a/", 1), ("string<=3", 1), ("", 1),
        ("int32]", 2), ("int32[][]", 2), ("int32[-1]", 2), ("string<=x", 2), ("int32<=3", 2), ("duration", 2),
        ("A/Pose", 2), ("a/My_Pose", 2), ("/Pose", 2), ("a__b/Pose", 2), ("[3]", 2), ("", 2),
    ],
)  # fmt: skip
def test_no_types(written, generation):
    with pytest.raises(MisreadError) as caught:
        field_type(written, "m", generation)
    assert caught.value.found.startswith("type ")
    assert caught.value.expected


@pytest.mark.parametrize(("check", "name", "generation"), [
    (check_field_name, "A1_b__", 1), (check_field_name, "a_1", 2),
    (check_constant_name, "lower", 1), (check_constant_name, "A_1", 2),
])  # fmt: skip
def test_names(check, name, generation):
    check(name, generation)


@pytest.mark.parametrize(("check", "name", "generation"), [
    (check_field_name, "_a", 1), (check_field_name, "a_", 2), (check_field_name, "aB", 2),
    (check_constant_name, "", 1), (check_constant_name, "a b", 1), (check_constant_name, "lower", 2),
    (check_constant_name, "A_", 2),
])  # fmt: skip
def test_no_names(check, name, generation):
    with pytest.raises(MisreadError):
        check(name, generation)


def test_a_long_name_that_is_none_is_told_at_once():
    with soon(1.0), pytest.raises(MisreadError):
        check_constant_name("A" * 10_000 + "a", 2)


@pytest.mark.parametrize("digits", ["4294967296", "99999999999999999999", "9" * 5000])
@pytest.mark.parametrize(
    ("form", "generation"),
    [("string<={}", 2), ("int32[<={}]", 2), ("int32[{}]", 2), ("a/B[{}]", 2), ("string<={}[2]", 2), ("int32[{}]", 1)],
)
def test_a_length_that_no_message_can_have(form, generation, digits):
    with pytest.raises(MisreadError, match="a length of"):
        field_type(form.format(digits), "m", generation)
