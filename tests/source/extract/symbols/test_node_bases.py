import pytest

from roslens.source.extract.symbols.node_bases import NODE_BASES, generation_of


@pytest.mark.parametrize(
    ("text", "generation"),
    [
        ("#include <ros/ros.h>", "ros1"),
        ("#include <std_msgs/String.h>", "ros1"),
        ('#include "rclcpp/rclcpp.hpp"', "ros2"),
        ("#include <std_msgs/msg/string.hpp>", "ros2"),
    ],
)
def test_by_what_a_file_includes(index_of, text, generation):
    assert generation_of(index_of(a_cpp=text), "pkg/a.cpp") == generation


def test_by_most_of_the_package_where_a_file_does_not_say(index_of):
    index = index_of(a_cpp="class A {};", b_cpp="#include <rclcpp/rclcpp.hpp>")
    assert generation_of(index, "pkg/a.cpp") == "ros2"


def test_bases_say_generation_and_kind():
    assert NODE_BASES["rclcpp.Node"] == ("ros2", "node")
    assert NODE_BASES["nodelet.Nodelet"] == ("ros1", "nodelet")
