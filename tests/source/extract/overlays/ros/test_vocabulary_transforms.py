"""Buffers of transforms, which may serve their frames."""

import pytest

from roslens.source.extract.symbolic.condition import as_written

ROS1 = """
import rospy
import tf2_ros
rospy.init_node('a')
"""
ROS2 = """
import tf2_ros
from rclpy.node import Node
class A(Node):
    def __init__(self):
        super().__init__('a')
        self.buffer = tf2_ros.Buffer({})
"""
SOURCE = """
import rospy
class Buffer:
    def __init__(self, cache_time=None, debug=True):
        try:
            look()
        except Error:
            self.frames = rospy.Service('~tf2_frames', FrameGraph, self.frames)
"""


def services(facts):
    found = [one for one in facts.endpoints if one.role.value == "service_server"]
    return [(str(one.name), str(one.type), as_written(one.conditions)) for one in found]


@pytest.mark.parametrize(
    ("code", "found"),
    [
        ("b = tf2_ros.Buffer()", [("~tf2_frames", "tf2_msgs/FrameGraph", ())]),
        ("b = tf2_ros.Buffer(rospy.Duration(3))\nc = tf2_ros.Buffer()", [("~tf2_frames", "tf2_msgs/FrameGraph", ())]),
        ("b = tf2_ros.Buffer(debug=False)", []),
        (
            "b = tf2_ros.Buffer(None, rospy.get_param('~debug'))",
            [("~tf2_frames", "tf2_msgs/FrameGraph", ("its buffer of transforms is created with debug",))],
        ),
    ],
)
def test_of_rospy(units, code, found):
    (facts,) = units(a_py=f"{ROS1}{code}\nrospy.Publisher('p', String)\n")
    assert services(facts) == found


def test_it_is_known_better_than_what_its_code_says(index_of):
    from roslens.source.extract.units.node_units import facts_of_module

    programs = index_of(a_py=ROS1 + "b = tf2_ros.Buffer()\n", b_py=SOURCE).programs
    renamed = {"pkg/a.py": programs["pkg/a.py"], "tf2_ros/src/tf2_ros/buffer.py": programs["pkg/b.py"]}
    index = type(index_of())(renamed)
    (facts,) = facts_of_module(index, "pkg/a.py")
    assert services(facts) == [("~tf2_frames", "tf2_msgs/FrameGraph", ())]


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ("", []),
        ("node=self", [("tf2_frames", "tf2_msgs/srv/FrameGraph", ())]),
        ("None, self", [("tf2_frames", "tf2_msgs/srv/FrameGraph", ())]),
        ("node=None", []),
    ],
)
def test_of_rclpy(units, given, found):
    (facts,) = units(a_py=ROS2.format(given))
    assert services(facts) == found


@pytest.mark.parametrize(
    ("given", "found"),
    [
        ("get_clock()", []),
        ("get_clock(), tf2::durationFromSec(10), this", [("tf2_frames", "tf2_msgs/srv/FrameGraph", ())]),
        ("get_clock(), tf2::durationFromSec(10), shared_from_this()", [("tf2_frames", "tf2_msgs/srv/FrameGraph", ())]),
    ],
)
@pytest.mark.parametrize("make", ["tf2_ros::Buffer b({});", "auto b = std::make_shared<tf2_ros::Buffer>({});"])
def test_of_rclcpp(node_of, given, found, make):
    assert services(node_of(make.replace("{}", given))) == found


def test_a_member_of_rclcpp(units):
    text = """
#include <rclcpp/rclcpp.hpp>
#include <tf2_ros/buffer.h>
class A : public rclcpp::Node { public: A() : Node("a"), buffer_(get_clock(), tf2::durationFromSec(10), this) {}
  tf2_ros::Buffer buffer_;
};
"""
    (facts,) = units(a_cpp=text)
    assert services(facts) == [("tf2_frames", "tf2_msgs/srv/FrameGraph", ())]


def test_of_roscpp(main_of):
    assert services(main_of("tf2_ros::Buffer b;")) == []
    assert services(main_of("tf2_ros::Buffer b(ros::Duration(3), true);")) == [
        ("~tf2_frames", "tf2_msgs/FrameGraph", ())
    ]
