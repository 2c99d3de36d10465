"""Hashes of ROS 2 types; those that are written here are of the packages that were released."""

from roslens.source.extract.interfaces.interface import Checksum, Interface
from roslens.source.extract.interfaces.interface_file import read_interface
from roslens.source.extract.interfaces.type_hash import type_hash, type_hashes


def read(full_name: str, text: str) -> Interface:
    package, kind, name = full_name.split("/")
    return read_interface(text.encode(), f"{name}.{kind}", package, 2)[0]


FILES = {
    "rmw_dds_common/msg/Gid": "char[16] data\n",
    "builtin_interfaces/msg/Time": "int32 sec\nuint32 nanosec\n",
    "std_msgs/msg/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "std_msgs/msg/String": "string data\n",
    "unique_identifier_msgs/msg/UUID": "uint8[16] uuid\n",
    "service_msgs/msg/ServiceEventInfo": (
        "uint8 REQUEST_SENT = 0\nuint8 event_type\nbuiltin_interfaces/Time stamp\nchar[16] client_gid\n"
        "int64 sequence_number\n"
    ),
    "std_srvs/srv/Empty": "---\n",
    "a/action/Go": "int32 x\n---\n---\n",
    "a/msg/Self": "Self[] again\n",
    "a/msg/Lost": "b/Missing m\n",
    "a/msg/Above": "Lost lost\n",
    "a/msg/Broken": "what\n",
    "a/msg/OverBroken": "Broken broken\n",
    "a/msg/Plain": "int32 x\n",
    "a/msg/Told": "# told\nint32 A=1\nint32 x 3 # three\n",
}
ALL = {name: read(name, text) for name, text in FILES.items()}


def of(name: str) -> Checksum:
    return type_hash(ALL[name], ALL.get)


def test_known_hashes():
    assert of("rmw_dds_common/msg/Gid").text == (
        "RIHS01_ab6f21cfbb0a6dbb837161e1110c2051a2850ed9f9c53944d7115d9bcebedf71"
    )
    assert of("std_msgs/msg/String").text == "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
    assert of("std_msgs/msg/Header").text == "RIHS01_f49fb3ae2cf070f793645ff749683ac6b06203e41c891e17701b1cb597ce6a01"


def test_defaults_constants_and_comments_do_not_count():
    plain, told = of("a/msg/Plain"), type_hash(read("a/msg/Plain", FILES["a/msg/Told"]), ALL.get)
    assert plain == told
    assert plain != of("a/msg/Told")


def test_what_services_and_actions_consist_of():
    assert sorted(type_hashes(ALL["std_srvs/srv/Empty"], ALL.get)) == [
        "std_srvs/srv/Empty",
        "std_srvs/srv/Empty_Event",
        "std_srvs/srv/Empty_Request",
        "std_srvs/srv/Empty_Response",
    ]
    found = type_hashes(ALL["a/action/Go"], ALL.get)
    assert {name.removeprefix("a/action/Go") for name in found} == {
        "", "_Goal", "_Result", "_Feedback", "_FeedbackMessage",
        "_SendGoal", "_SendGoal_Request", "_SendGoal_Response", "_SendGoal_Event",
        "_GetResult", "_GetResult_Request", "_GetResult_Response", "_GetResult_Event",
    }  # fmt: skip
    assert all(found.values())
    assert len({checksum.text for checksum in found.values()}) == len(found)


def test_what_is_not_known_says_why():
    assert of("a/msg/Self") == Checksum(unknown="a/msg/Self contains itself")
    lost = "'b/msg/Missing', the type of field 'm' of a/msg/Lost, is unknown"
    assert of("a/msg/Lost") == of("a/msg/Above") == Checksum(unknown=lost)
    broken = Checksum(unknown="the file of a/msg/Broken could not be parsed completely")
    assert of("a/msg/Broken") == of("a/msg/OverBroken") == broken
    other = read_interface(b"", "M.msg", "a", 1)[0]
    assert type_hash(other, ALL.get).unknown == "a/msg/M is an interface of ROS 1"
    wrong = {"b/msg/Missing": other}
    assert type_hash(ALL["a/msg/Lost"], wrong.get).unknown == "b/msg/Missing is not a message of ROS 2"


def test_what_rosidl_misreads_is_not_known():
    found = type_hash(read("a/msg/Wide", "wstring<=3[] words\n"), ALL.get)
    assert found.unknown.startswith("versions of rosidl do not agree on an unbounded array of bounded wide strings")


def test_depth_is_limited():
    chain = {f"a/msg/M{n}": read(f"a/msg/M{n}", f"M{n + 1} next\n") for n in range(5000)}
    assert type_hash(chain["a/msg/M0"], chain.get).unknown.startswith("more than 100 levels of nested messages")
