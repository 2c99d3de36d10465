"""Quality of service, as code writes it."""

import pytest


@pytest.mark.parametrize(
    ("given", "quality"),
    [
        ("10", ("reliable", "volatile", "keep_last", 10)),
        ("rclcpp::QoS(3).best_effort().transient_local()", ("best_effort", "transient_local", "keep_last", 3)),
        ("rclcpp::SensorDataQoS()", ("best_effort", "volatile", "keep_last", 5)),
        ("rclcpp::QoS(rclcpp::KeepAll())", ("reliable", "volatile", "keep_all", 0)),
    ],
)
def test_quality_of_service(node_of, given, quality):
    (one,) = node_of(f'pub_ = create_publisher<std_msgs::msg::String>("a", {given});').endpoints
    assert (one.qos.reliability, one.qos.durability, one.qos.history, one.qos.depth) == quality
    assert one.qos_unknown == ""


def test_a_depth_that_a_parameter_decides(node_of):
    body = 'int depth = declare_parameter("depth", 5);\n'
    (one,) = node_of(body + 'pub_ = create_publisher<std_msgs::msg::String>("a", rclcpp::QoS(depth));').endpoints
    assert "depth" in one.qos_unknown
