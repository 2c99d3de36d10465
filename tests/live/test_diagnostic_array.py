from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rosbags.typesys import Stores, get_typestore

from roslens.live.reported.diagnostic_array import ArrayError, read_array
from roslens.live.reported.reported_levels import Report

ROS1, ROS2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_HUMBLE)
NAME = "diagnostic_msgs/msg/DiagnosticArray"


def serialised(statuses, cdr, little=True):
    types = (ROS2 if cdr else ROS1).types
    header = {"stamp": types["builtin_interfaces/msg/Time"](1, 2), "frame_id": "base"} | ({} if cdr else {"seq": 7})
    message = types[NAME](
        types["std_msgs/msg/Header"](**header),
        [
            types["diagnostic_msgs/msg/DiagnosticStatus"](
                level, name, text, hardware, [types["diagnostic_msgs/msg/KeyValue"](*pair) for pair in values]
            )
            for level, name, text, hardware, values in statuses
        ],
    )
    return bytes(ROS2.serialize_cdr(message, NAME, little_endian=little) if cdr else ROS1.serialize_ros1(message, NAME))


TEXT = st.text(st.characters(exclude_characters="\0", exclude_categories=("Cs",)), max_size=12)
STATUSES = st.lists(
    st.tuples(st.integers(0, 127), TEXT, TEXT, TEXT, st.lists(st.tuples(TEXT, TEXT), max_size=3)), max_size=4
)


@given(STATUSES, st.booleans(), st.booleans())
def test_what_was_serialised_is_read(statuses, cdr, little):
    body = serialised(statuses, cdr, little)
    assert read_array(body, cdr=cdr) == [Report(name, level, text, hw) for level, name, text, hw, _ in statuses]


@given(STATUSES.filter(bool), st.booleans(), st.data())
def test_a_part_of_it_is_none(statuses, cdr, data):
    body = serialised(statuses, cdr)
    with pytest.raises(ArrayError):
        read_array(body[: data.draw(st.integers(0, len(body) - 4))], cdr=cdr)


@given(st.binary(), st.booleans())
def test_any_bytes_are_read_or_refused(body, cdr):
    with suppress(ArrayError):
        read_array(body, cdr=cdr)


def test_endless_numbers_are_refused():
    for cdr in (True, False):
        body = bytearray(serialised([], cdr))
        body[-4:] = b"\xff\xff\xff\xff"
        with pytest.raises(ArrayError, match="statuses"):
            read_array(bytes(body), cdr=cdr)
