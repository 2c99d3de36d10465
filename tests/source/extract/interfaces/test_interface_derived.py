"""Messages that services and actions of ROS 1 consist of."""

from roslens.source.extract.interfaces.interface_derived import ros1_messages
from roslens.source.extract.interfaces.interface_file import read_interface


def names_of(content: bytes, path: str) -> dict[str, list[str]]:
    found = ros1_messages(read_interface(content, path, "m", 1)[0])
    return {
        one.full_name: [f"{field.type.message or field.type.name} {field.name}" for field in one.parts[0].fields]
        for one in found
    }


def test_service():
    assert names_of(b"int32 a\n---\nstring b\n", "S.srv") == {
        "m/msg/SRequest": ["int32 a"],
        "m/msg/SResponse": ["string b"],
    }


def test_action():
    assert names_of(b"int32 a\n---\n---\nint8 c\n", "A.action") == {
        "m/msg/AGoal": ["int32 a"],
        "m/msg/AResult": [],
        "m/msg/AFeedback": ["int8 c"],
        "m/msg/AActionGoal": ["std_msgs/msg/Header header", "actionlib_msgs/msg/GoalID goal_id", "m/msg/AGoal goal"],
        "m/msg/AActionResult": [
            "std_msgs/msg/Header header", "actionlib_msgs/msg/GoalStatus status", "m/msg/AResult result",
        ],
        "m/msg/AActionFeedback": [
            "std_msgs/msg/Header header", "actionlib_msgs/msg/GoalStatus status", "m/msg/AFeedback feedback",
        ],
        "m/msg/AAction": [
            "m/msg/AActionGoal action_goal",
            "m/msg/AActionResult action_result",
            "m/msg/AActionFeedback action_feedback",
        ],
    }  # fmt: skip


def test_message():
    assert names_of(b"int32 a\n", "M.msg") == {}


def test_what_is_derived_from_a_faulty_file_is_faulty():
    assert not any(one.complete for one in ros1_messages(read_interface(b"what\n---\n", "S.srv", "m", 1)[0]))
