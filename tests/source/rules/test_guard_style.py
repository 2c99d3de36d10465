import pytest

from roslens.source.rules.guard_style import GOOGLE, ROS1, ROS2, guard_name, guard_style


@pytest.mark.parametrize(
    ("inside", "style", "name"),
    [
        ("include/arm/joint/motor.hpp", ROS2, "ARM__JOINT__MOTOR_HPP_"),
        ("include/arm/arm/motor.hpp", ROS2, "ARM__MOTOR_HPP_"),
        ("src/motor.hpp", ROS2, "ARM__MOTOR_HPP_"),
        ("motor.h", ROS2, "ARM__MOTOR_H_"),
        ("include/arm/motor.h", ROS1, "ARM_MOTOR_H"),
        ("include/arm/motor-driver.h", GOOGLE, "ARM_MOTOR_DRIVER_H_"),
        ("include/other/motor.h", ROS1, "ARM_OTHER_MOTOR_H"),
    ],
)
def test_it_is_named_as_the_guide_has_it(inside, style, name):
    assert guard_name(inside, "arm", style) == name


def test_a_package_that_begins_with_a_digit_makes_a_name_all_the_same():
    assert guard_name("include/3d/a.h", "3d", ROS1) == "H_3D_A_H"


@pytest.mark.parametrize(
    ("profiles", "ros", "style"),
    [(("auto",), {2}, ROS2), (("auto",), {1}, ROS1), (("auto",), {1, 2}, ROS2), (("auto", "google"), {2}, GOOGLE)],
)
def test_the_style_is_that_of_the_profile(profiles, ros, style):
    assert guard_style(profiles, ros) == style
