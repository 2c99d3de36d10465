import pytest

from roslens.source.extract.catalogue.catalogue_bridge import bridged
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.text import Hole, Text

HERE = Evidence("a.launch.py", 1)


@pytest.mark.parametrize(
    ("word", "wanted"),
    [
        ("/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan", [("publisher", "/scan", "sensor_msgs/msg/LaserScan")]),
        ("cmd_vel@geometry_msgs/msg/Twist]gz.msgs.Twist", [("subscription", "cmd_vel", "geometry_msgs/msg/Twist")]),
        (
            "a@std_msgs/msg/String@gz.msgs.StringMsg",
            [("publisher", "a", "std_msgs/msg/String"), ("subscription", "a", "std_msgs/msg/String")],
        ),
        (
            "/w/control@ros_gz_interfaces/srv/ControlWorld",
            [("service_server", "/w/control", "ros_gz_interfaces/srv/ControlWorld")],
        ),
        ("--verbose", []),
        ("a@b", []),
        ("", []),
    ],
)
def test_words_say_what_is_bridged_and_which_way(word, wanted):
    found = [(one.role.value, one.name.known, one.type.known) for one in bridged([Text.of(word)], HERE)]
    assert found == wanted


def test_a_name_may_have_holes():
    (one,) = bridged([Text.of(Hole("argument robot"), "/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan")], HERE)
    assert one.name.pattern == "*/scan"
