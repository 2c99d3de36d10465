import pytest

from roslens.source.rules.distribution.linked_targets import linked


def _after(text, line=1):
    edit = linked(text.encode(), line, "CMakeLists.txt")
    return None if edit is None else f"{text[: edit.start]}{edit.text}{text[edit.end :]}"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("ament_target_dependencies(a rclcpp std_msgs)", "target_link_libraries(a rclcpp::rclcpp ${std_msgs_TARGETS})"),
        ("ament_target_dependencies(a PUBLIC tf2_ros)", "target_link_libraries(a PUBLIC tf2_ros::tf2_ros)"),
        (
            "  ament_target_dependencies(${PROJECT_NAME}\n    Eigen3\n)",
            "  target_link_libraries(${PROJECT_NAME}\n    Eigen3::Eigen\n)",
        ),
        ("ament_target_dependencies(rclcpp rclcpp)", "target_link_libraries(rclcpp rclcpp::rclcpp)"),
    ],
)
def test_a_call_with_known_packages_links_their_targets(before, after):
    assert _after(before) == after


@pytest.mark.parametrize(
    "text",
    [
        "ament_target_dependencies(a rclcpp own_library)",
        "ament_target_dependencies(a ${dependencies})",
        "ament_target_dependencies(a SYSTEM rclcpp)",
        'ament_target_dependencies(a "rclcpp")',
        "ament_target_dependencies(a rclcpp # first\n std_msgs)",
        "ament_target_dependencies()",
        "set(a b)",
    ],
)
def test_any_other_call_is_left(text):
    assert _after(text) is None


def test_the_call_of_the_line_is_meant():
    text = "ament_target_dependencies(a rclcpp)\nament_target_dependencies(b rclcpp)\n"
    assert _after(text, 2) == "ament_target_dependencies(a rclcpp)\ntarget_link_libraries(b rclcpp::rclcpp)\n"
