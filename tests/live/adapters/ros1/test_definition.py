import math
import struct
from pathlib import Path

import pytest

from roslens.live import publish
from roslens.live.adapters.ros1.wire.definition import Definitions, Field, known_definitions, read_definition
from roslens.live.publish.rated import SEVERITIES, STATES
from roslens.model.acting.outgoing import ConnectionStatistics, RatedSignal, RatedSignals

PACKAGE = Path(__file__).parents[4] / "ros" / "roslens_msgs" / "msg"
STRUCTS = {"RatedSignal": RatedSignal, "ConnectionStatistics": ConnectionStatistics, "RatedSignals": RatedSignals}
PYTHON = {str: "string", float: "float64", bool: "bool"}


def test_what_is_published_is_what_the_package_defines():
    own = Path(publish.__file__).with_name("msg")
    assert {file.name: file.read_text() for file in own.iterdir()} == {
        file.name: file.read_text() for file in PACKAGE.iterdir()
    }


@pytest.mark.parametrize("name", STRUCTS)
def test_fields_are_those_of_the_frames_in_their_order(name):
    fields = [field for field in known_definitions().fields(f"roslens_msgs/{name}") if field.name != "header"]
    assert tuple(field.name for field in fields) == STRUCTS[name].__struct_fields__


@pytest.mark.parametrize("name", STRUCTS)
def test_each_field_says_what_it_is(name):
    for line in (PACKAGE / f"{name}.msg").read_text().splitlines():
        if line and not line.startswith(("#", "uint8 SEVERITY_")):
            assert "  # " in line, line


def test_constants_are_the_states_and_severities():
    text = (PACKAGE / "RatedSignal.msg").read_text()
    constants = {one.name: int(one.value) for one in read_definition("p/M", text) if one.value is not None}
    assert constants == {
        **{f"STATE_{state.name}": number for state, number in STATES.items()},
        **{f"SEVERITY_{severity.name}": number for severity, number in SEVERITIES.items()},
    }


@pytest.mark.parametrize(
    ("name", "md5"),
    [
        ("std_msgs/Header", "2176decaecbce78abc3b96ef049fabed"),
        ("diagnostic_msgs/KeyValue", "cf57fdc6617a881a88c16e768132149c"),
        ("diagnostic_msgs/DiagnosticStatus", "d0ce08bc6e5ba34c7754f563a9cabaf1"),
        ("diagnostic_msgs/DiagnosticArray", "60810da900de1dd6ddd437c3503511da"),
        ("roslens_msgs/RatedSignals", "84835e60969b503d7ab85947740f06cb"),
    ],
)
def test_sums_are_those_of_genmsg(name, md5):
    assert known_definitions().md5(name) == md5


def test_lines_are_read():
    text = "# what\nuint8 A=1 # one\n\nfloat64[] x   # y\nHeader header\nOther[] others\n"
    assert read_definition("p/M", text) == (
        Field("uint8", "A", value="1"), Field("float64", "x", True), Field("std_msgs/Header", "header"),
        Field("p/Other", "others", True),
    )  # fmt: skip
    with pytest.raises(ValueError, match="expected `type name`"):
        read_definition("p/M", "what is this")


def test_serialised_as_ros_does_it():
    definitions = Definitions({"p/M": "uint8 a\nbool b\nstring s\ntime t\nfloat64[] f\nN[] n", "p/N": "uint16 x"})
    body = definitions.packer("p/M")((1, True, "hé", 1.5, [0.5, math.inf], [(7,), (8,)]))
    assert body == (
        b"\x01\x01" + b"\x03\x00\x00\x00h\xc3\xa9" + struct.pack("<II", 1, 500_000_000)
        + struct.pack("<Idd", 2, 0.5, math.inf) + struct.pack("<IHH", 2, 7, 8)
    )  # fmt: skip
    with pytest.raises(ValueError, match="zip"):
        definitions.packer("p/N")(())


def test_the_whole_text_holds_each_message_once():
    text = known_definitions().whole_text("roslens_msgs/RatedSignals")
    assert [line for line in text.splitlines() if line.startswith("MSG: ")] == [
        "MSG: std_msgs/Header", "MSG: roslens_msgs/RatedSignal", "MSG: roslens_msgs/ConnectionStatistics",
    ]  # fmt: skip
