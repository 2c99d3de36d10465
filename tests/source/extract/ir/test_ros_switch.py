import pytest

from roslens.source.extract.ir.ros_switch import has_switch, holds


@pytest.mark.parametrize(
    ("directive", "ros1"),
    [
        (b"#ifdef ROS1", True),
        (b"#ifdef USING_ROS_1  // of old", True),
        (b"#ifndef USING_ROS_1", False),
        (b"#ifdef IS_ROS2", False),
        (b"#ifdef COMPILED_WITH_CATKIN", True),
        (b"# ifdef CATKIN_BUILD", True),
        (b"#elif defined(COMPILED_WITH_AMENT)", False),
        (b"#if defined ROS2", False),
        (b"#if !defined(ROS2)", True),
        (b"#if ROS_VERSION == 1", True),
        (b"#if (ROS_VERSION < 2)", True),
        (b"#if __has_include(<rclcpp/rclcpp.hpp>)", False),
        (b"#if defined(ROS1) || defined(OTHER)", True),
        (b"#if defined(ROS2) && defined(OTHER)", False),
    ],
)
def test_a_condition_that_asks_for_the_version(directive, ros1):
    assert holds(directive, "ros1") is ros1
    assert holds(directive, "ros2") is not ros1
    assert has_switch(b"int a;\n" + directive + b"\n#endif\n")


@pytest.mark.parametrize(
    "directive",
    [
        b"#ifdef ROS_DISTRO_GALACTIC",
        b"#if ROS_VERSION_MINIMUM(1,14,0)",
        b"#if RCLCPP_VERSION_GTE(30, 0, 0)",
        b"#ifdef ROS2_VER_N520",
        b"#ifdef ROSPACK_EXPORT",
        b"#if ROS_VERSION == 1 || (A && B)",
        b"#if !defined(COMPILED_WITH_CATKIN) && (A || B)",
        b"#else",
    ],
)
def test_a_condition_that_asks_for_something_else(directive):
    assert {holds(directive, version) for version in ("ros1", "ros2")} <= {None, True, False}
    assert None in {holds(directive, version) for version in ("ros1", "ros2")}


def test_a_file_without_such_a_condition_has_no_variants():
    assert not has_switch(b"#ifdef DEBUG\n// ROS1\n#endif\n")
