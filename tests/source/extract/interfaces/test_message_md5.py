"""Sums of ROS 1 types; those of std_msgs and geometry_msgs are known by heart to every connection of ROS 1."""

from roslens.source.extract.interfaces.interface import Checksum, Interface
from roslens.source.extract.interfaces.interface_file import read_interface
from roslens.source.extract.interfaces.message_md5 import md5_of, md5_sums


def read(full_name: str, text: str) -> Interface:
    package, kind, name = full_name.split("/")
    return read_interface(text.encode(), f"{name}.{kind}", package, 1)[0]


FILES = {
    "std_msgs/msg/String": "string data\n",
    "std_msgs/msg/Empty": "",
    "std_msgs/msg/Header": "# seq\nuint32 seq\ntime stamp\nstring frame_id\n",
    "geometry_msgs/msg/Point": "float64 x\nfloat64 y\nfloat64 z\n",
    "geometry_msgs/msg/Quaternion": "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n",
    "geometry_msgs/msg/Pose": "Point position\nQuaternion orientation\n",
    "geometry_msgs/msg/PoseStamped": "Header header\nPose pose\n",
    "std_srvs/srv/SetBool": "bool data # e.g. enable\n---\nbool success\nstring message\n",
    "std_srvs/srv/Empty": "---\n",
    "a/msg/Self": "Self[] again\n",
    "a/msg/Lost": "b/Missing m\n",
    "a/msg/Above": "Lost lost\n",
    "a/msg/Broken": "what\n",
    "a/msg/OverBroken": "Broken broken\n",
}
ALL = {name: read(name, text) for name, text in FILES.items()}


def of(name: str) -> Checksum:
    return md5_of(ALL[name], ALL.get)


def test_known_sums():
    assert of("std_msgs/msg/String").text == "992ce8a1687cec8c8bd883ec73ca41d1"
    assert of("std_msgs/msg/Empty").text == "d41d8cd98f00b204e9800998ecf8427e"
    assert of("std_msgs/msg/Header").text == "2176decaecbce78abc3b96ef049fabed"
    assert of("geometry_msgs/msg/PoseStamped").text == "d3812c3cbc69362b77dc0b19b345f8f5"
    assert of("std_srvs/srv/SetBool").text == "09fb03525b03e7ea1fd3992bafd87e16"
    assert of("std_srvs/srv/Empty").text == "d41d8cd98f00b204e9800998ecf8427e"


def test_parts_of_a_service():
    assert set(md5_sums(ALL["std_srvs/srv/SetBool"], ALL.get)) == {
        "std_srvs/srv/SetBool",
        "std_srvs/msg/SetBoolRequest",
        "std_srvs/msg/SetBoolResponse",
    }


def test_an_action_has_the_sum_of_its_message():
    action = read("a/action/Go", "int32 x\n---\n---\n")
    header_only = {**ALL, "actionlib_msgs/msg/GoalID": read("actionlib_msgs/msg/GoalID", "time stamp\nstring id\n")}
    assert md5_of(action, header_only.get).unknown == (
        "'actionlib_msgs/msg/GoalStatus', the type of field 'status' of a/msg/GoActionResult, is unknown"
    )
    status = read("actionlib_msgs/msg/GoalStatus", "GoalID goal_id\nuint8 status\nstring text\n")
    found = md5_sums(action, {**header_only, status.full_name: status}.get)
    assert found["a/action/Go"] == found["a/msg/GoAction"]
    assert len(found) == 8
    assert all(found.values())


def test_what_is_not_known_says_why():
    assert of("a/msg/Self") == Checksum(unknown="a/msg/Self contains itself")
    lost = "'b/msg/Missing', the type of field 'm' of a/msg/Lost, is unknown"
    assert of("a/msg/Lost") == of("a/msg/Above") == Checksum(unknown=lost)
    broken = Checksum(unknown="the file of a/msg/Broken could not be parsed completely")
    assert of("a/msg/Broken") == of("a/msg/OverBroken") == broken
    other = read_interface(b"", "M.msg", "a", 2)[0]
    assert md5_of(other, ALL.get).unknown == "a/msg/M is an interface of ROS 2"


def test_depth_is_limited():
    chain = {f"a/msg/M{n}": read(f"a/msg/M{n}", f"M{n + 1} next\n") for n in range(5000)}
    assert md5_of(chain["a/msg/M0"], chain.get).unknown.startswith("more than 100 levels of nested messages")
