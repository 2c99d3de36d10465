"""What a change of a definition breaks, by the rules of RIHS01 (ROS 2) and of genmsg's MD5 (ROS 1)."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.interfaces.interface_change import Breaks
from roslens.source.extract.interfaces.interface_changes import changes_of
from roslens.source.extract.interfaces.interface_file import read_interface
from roslens.source.extract.interfaces.message_md5 import md5_of
from roslens.source.extract.interfaces.type_hash import type_hash

WIRE, SOURCE, MEANING = Breaks.WIRE, Breaks.SOURCE, Breaks.MEANING


def _read(text, name="A.msg", generation=2):
    return read_interface(text.encode(), name, "pkg", generation)[0]


def _changes(before, after, name="A.msg", generation=2):
    full = f"pkg/{name.rpartition('.')[2]}/{name.rpartition('.')[0]}"
    old, new = _read(before, name, generation), _read(after, name, generation)
    return [(one.what, one.breaks) for one in changes_of({full: (old, name)}, {full: (new, name)})]


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ("int32 a\nint32 b", "int32 a\nint32 b", []),
        ("int32 a", "# said\nint32  a   # more", []),
        ("int32 a", "int64 a", [("field a is of type int64, was int32", (WIRE, SOURCE))]),
        ("int32[] a", "int32[4] a", [("field a is of type int32[4], was int32[]", (WIRE, SOURCE))]),
        ("string a", "string<=5 a", [("field a is of type string<=5, was string", (WIRE, SOURCE))]),
        ("int32 a", "int32 a\nint32 b", [("field b added", (WIRE,))]),
        ("int32 a\nint32 b", "int32 a", [("field b removed", (WIRE, SOURCE))]),
        ("int32 a\nint8 b", "int32 a\nint8 c", [("field b renamed to c", (WIRE, SOURCE))]),
        ("int32 a\nint8 b", "int8 b\nint32 a", [("fields reordered: b, a", (WIRE,))]),
        ("int32 a 5", "int32 a 6", [("default of field a is 6, was 5", (MEANING,))]),
        ("int32 A=1", "int32 A=2", [("constant A is 2, was 1", (MEANING,))]),
        ("int32 A=1", "int32 A=0x1", []),
        ("int32 A=1", "", [("constant A removed", (SOURCE,))]),
        ("", "int32 A=1", [("constant A added", ())]),
    ],
)
def test_what_a_change_breaks_in_ros_2(before, after, expected):
    assert _changes(before, after) == expected


def test_a_constant_is_part_of_the_type_in_ros_1():
    assert _changes("int32 A=1", "int32 A=2", generation=1) == [("constant A is 2, was 1", (WIRE, MEANING))]
    assert _changes("", "int32 A=1", generation=1) == [("constant A added", (WIRE,))]


def test_a_part_of_a_service_is_named():
    assert _changes("int32 a\n---\nbool b", "int32 a\n---\nint8 b", "A.srv") == [
        ("response: field b is of type int8, was bool", (WIRE, SOURCE))
    ]


def test_an_interface_that_is_renamed_gone_or_new():
    a, b, c = (_read("int32 a", f"{name}.msg") for name in "ABC")
    other = _read("float64 x", "D.msg")
    found = changes_of({"pkg/msg/A": (a, "A.msg")}, {"pkg/msg/B": (b, "B.msg")})
    assert [(one.interface, one.what) for one in found] == [("pkg/msg/A", "renamed to pkg/msg/B")]
    found = changes_of({"pkg/msg/A": (a, "A.msg")}, {"pkg/msg/D": (other, "D.msg")})
    assert [(one.interface, one.what, bool(one.breaks)) for one in found] == [
        ("pkg/msg/A", "removed", True), ("pkg/msg/D", "added", False),
    ]  # fmt: skip
    # Of two that fit neither is taken for the other name.
    found = changes_of({"pkg/msg/A": (a, "A.msg")}, {"pkg/msg/B": (b, "B.msg"), "pkg/msg/C": (c, "C.msg")})
    assert [one.what for one in found] == ["removed", "added", "added"]


def test_what_was_not_understood_is_not_compared():
    assert _changes("int32 a", "int32 Wrong") == []


_FIELDS = st.lists(
    st.tuples(st.sampled_from(["int8", "int32[]", "string<=4", "other/Thing"]), st.sampled_from("abcd")),
    max_size=4,
    unique_by=lambda one: one[1],
)


@given(_FIELDS, _FIELDS, st.sampled_from([1, 2]))
def test_the_checksum_differs_exactly_where_the_wire_breaks(before, after, generation):
    def text(fields):
        found = "\n".join(f"{kind} {name}" for kind, name in fields)
        return found.replace("<=4", "") if generation == 1 else found

    def lookup(name):
        assert name == "other/msg/Thing"
        return read_interface(b"int32 x", "Thing.msg", "other", generation)[0]

    checksum = md5_of if generation == 1 else type_hash
    sums = {checksum(_read(text(one), generation=generation), lookup).text for one in (before, after)}
    broken = any(WIRE in breaks for _, breaks in _changes(text(before), text(after), generation=generation))
    assert broken == (len(sums) == 2)
