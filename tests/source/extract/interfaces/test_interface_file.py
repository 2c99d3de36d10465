"""Interface files of both generations, their faults, and whatever else comes along."""

import random
from pathlib import Path

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslens.source.extract.interfaces.interface import FieldType, Interface, InterfaceConstant, InterfaceField
from roslens.source.extract.interfaces.interface_file import read_interface
from roslens.source.extract.interfaces.message_md5 import md5_sums
from roslens.source.extract.interfaces.type_hash import type_hashes

FIXTURES = Path(__file__).parents[3] / "fixtures" / "extract" / "interfaces"
SEEDS = [path for folder in ("ros1", "ros2") for path in sorted((FIXTURES / folder).iterdir())]
PIECES = [
    *b"# = --- [] [3] [<=3] <=5 int32 string wstring float64 Header Nested a/B time bool x NAME 1 -1 1.5 true".split(),
    b"'a'", b"\xff", b"\xc3\xa9",
    b" ", b"\t", b"\n", b"\r\n", b"  ", b"\x0c", b"\xe2\x80\xa8",
]  # fmt: skip


def message(text: str, generation: int):
    interface, failures = read_interface(text.encode(), "m/msg/M.msg", "m", generation)
    assert not failures, [str(failure) for failure in failures]
    assert interface.complete
    return interface.parts[0]


def test_message_of_ros_2():
    found = message(
        "# Top.\n# More.\n\n# above\nstring<=5[<=2] names ['a', \"b\"]  # behind\n  # below\n"
        "Pose pose\nint32 A=3 # c\n",
        2,
    )
    assert found.comment == "Top.\nMore."
    assert found.fields == (
        InterfaceField(
            "names",
            FieldType("string", "", "bounded", 2, 5, "string<=5[<=2]"),
            ("a", "b"),
            "above\nbehind\nbelow",
            5,
            16,
        ),
        InterfaceField("pose", FieldType("Pose", "m", written="Pose"), None, "", 7, 6),
    )
    assert found.constants == (InterfaceConstant("A", "int32", 3, "3", "c", 8, 7),)


def test_message_of_ros_1():
    found = message(
        "# Top.\nHeader header\nfloat64[9]  k # behind\nstring S= a # b \nbyte B=-1 # c\nroslib/X[] xs\n", 1
    )
    assert found.comment == "Top."
    assert found.fields == (
        InterfaceField("header", FieldType("Header", "std_msgs", written="Header"), None, "", 2, 8),
        InterfaceField("k", FieldType("float64", "", "fixed", 9, 0, "float64[9]"), None, "behind", 3, 13),
        InterfaceField("xs", FieldType("X", "roslib", "unbounded", written="roslib/X[]"), None, "", 6, 12),
    )
    assert [(one.name, one.value, one.written) for one in found.constants] == [("S", "a # b", "a # b"), ("B", -1, "-1")]


def test_service_and_action():
    service, failures = read_interface(b"int32 a\n---\nint32 b\n", "S.srv", "m", 2)
    assert not failures
    assert (service.full_name, [part.fields[0].name for part in service.parts]) == ("m/srv/S", ["a", "b"])
    action, failures = read_interface(b"---\n---\nint32 c\n", "A.action", "m", 2)
    assert not failures
    assert [len(part.fields) for part in action.parts] == [0, 0, 1]


def test_ros_1_takes_more_for_a_separator():
    service, failures = read_interface(b"int32 a\n--- # answer\nint32 b\n---\nint32 c\n", "S.srv", "m", 1)
    assert not failures
    assert [[field.name for field in part.fields] for part in service.parts] == [["a"], ["b", "c"]]
    assert not read_interface(b"int32 a\n", "S.srv", "m", 1)[1]
    assert read_interface(b"int32 a\n", "A.action", "m", 1)[1]


@pytest.mark.parametrize(
    ("generation", "line", "found", "column"),
    [
        (1, "int32", "'int32'", 1),
        (1, "int32 a b", "'int32 a b'", 1),
        (1, "int32[][] a", "type 'int32[][]'", 1),
        (1, "int32 1a", "name '1a'", 1),
        (1, "uint8 A=256", "value '256'", 1),
        (1, "bool A=maybe", "value 'maybe'", 1),
        (1, "Pose A=1", "constant of type 'Pose'", 1),
        (1, "  string A=1", "name 'string A'", 3),
        (1, "uint8\tx", "'uint8\\tx'", 1),
        (1, "float32 A=1=2", "'float32 A=1=2'", 1),
        (2, "int32", "'int32'", 1),
        (2, "  int32 a", "'  int32 a'", 3),
        (2, "int32 Big", "name 'Big'", 1),
        (2, "int32 a__b", "name 'a__b'", 1),
        (2, "int32[0] a", "type 'int32[0]'", 1),
        (2, "int32[<=] a", "type 'int32[<=]'", 1),
        (2, "string<=0 a", "type 'string<=0'", 1),
        (2, "time a", "type 'time'", 1),
        (2, "a/b/C c", "type 'a/b/C'", 1),
        (2, "pose c", "type 'pose'", 1),
        (2, "int8 a 200", "value '200'", 1),
        (2, "int8[2] a [1]", "default '[1]' of 1 items", 1),
        (2, "int8[<=1] a [1, 2]", "default '[1, 2]' of 2 items", 1),
        (2, "int8[] a 1", "default '1'", 1),
        (2, "Pose a 1", "default '1'", 1),
        (2, "string<=2 a abc", "text 'abc' of 3 characters", 1),
        (2, "int32 a=1", "name 'a'", 1),
        (2, "Pose A=1", "constant of type 'Pose'", 1),
        (2, "int32 ok", "name 'ok' again", 7),
    ],
)
def test_what_is_refused(generation, line, found, column):
    content = f"int32 ok\n{line}\nint32 last\n".encode()
    interface, failures = read_interface(content, "m/msg/M.msg", "m", generation)
    assert [failure.what for failure in failures] == [found]
    assert str(failures[0].location) == f"m/msg/M.msg:2:{column}"
    assert failures[0].expected
    assert failures[0].advice
    assert not interface.complete
    assert [field.name for field in interface.parts[0].fields][:: len(interface.parts[0].fields) - 1] == ["ok", "last"]


def test_bytes_that_are_no_utf_8():
    assert not read_interface(b"int32 a # \xe9\n", "M.msg", "m", 1)[1]
    assert read_interface(b"string A=\xe9\n", "M.msg", "m", 1)[1]
    assert read_interface(b"int32 a # \xe9\n", "M.msg", "m", 2)[1]


def test_number_of_separators():
    for content in (b"", b"---\n---\n", b"int32 a\n"):
        _, failures = read_interface(content, "S.srv", "m", 2)
        assert failures[-1].expected == "1, between the parts of a .srv file"


def test_other_suffixes():
    with pytest.raises(ValueError, match=r"M\.idl: expected \.msg"):
        read_interface(b"", "M.idl", "m", 2)


def check(content: bytes, path: str, generation: int) -> None:
    """Hold what is read against what must be so for any content."""
    interface, failures = read_interface(content, path, "m", generation)
    assert interface.complete is not bool(failures)
    assert len(interface.parts) == {"msg": 1, "srv": 2, "action": 3}[interface.kind]
    encoded = msgspec.msgpack.encode(interface)
    assert msgspec.msgpack.decode(encoded, type=Interface) == interface
    for failure in failures:
        assert failure.location is not None
        assert failure.location.line >= 1
        assert failure.location.column >= 1
        assert failure.what
    hashed = md5_sums if generation == 1 else type_hashes
    for checksum in hashed(interface, lambda _: None).values():
        assert bool(checksum.text) is not bool(checksum.unknown)
        assert not (failures and checksum)


@given(st.binary(max_size=200), st.sampled_from(["M.msg", "S.srv", "A.action"]), st.sampled_from([1, 2]))
@settings(max_examples=200, deadline=None)
def test_any_bytes(content, path, generation):
    check(content, path, generation)


@given(
    st.lists(st.sampled_from(PIECES), max_size=40).map(b" ".join)
    | st.lists(st.sampled_from(PIECES), max_size=40).map(b"".join),
    st.sampled_from(["M.msg", "S.srv", "A.action"]),
    st.sampled_from([1, 2]),
)
@settings(max_examples=300, deadline=None)
def test_any_words(content, path, generation):
    check(content, path, generation)


def test_mutated_fixtures():
    chance = random.Random(8)
    for _ in range(600):
        path = chance.choice(SEEDS)
        content = bytearray(path.read_bytes())
        for _ in range(chance.randint(1, 6)):
            place, length = chance.randrange(len(content) + 1), chance.randint(0, 9)
            content[place : place + length] = chance.choice(
                [b"", chance.choice(PIECES), bytes([chance.randrange(256)])]
            )
        check(bytes(content), path.name, 1 if path.parent.name == "ros1" else 2)


@pytest.mark.parametrize("path", SEEDS, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_fixtures_are_understood(path):
    interface, failures = read_interface(path.read_bytes(), path.name, "m", 1 if path.parent.name == "ros1" else 2)
    assert not failures
    assert interface.complete
