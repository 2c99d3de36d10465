"""Generic endpoints, whose type is a text."""

import pytest


@pytest.mark.parametrize(
    ("written", "role", "type_"),
    [
        ('create_generic_publisher("a", "std_msgs/msg/String", rclcpp::QoS(3))', "publisher", "std_msgs/msg/String"),
        (
            'create_generic_subscription("a", "std_msgs/msg/String", rclcpp::QoS(3), [](auto) {})',
            "subscription",
            "std_msgs/msg/String",
        ),
        ('create_generic_client("a", "std_srvs/srv/Empty")', "service_client", "std_srvs/srv/Empty"),
        ('create_generic_publisher("a", type_of(topic), rclcpp::QoS(3))', "publisher", None),
    ],
)
def test_an_endpoint_with_a_type_that_is_a_text(node_of, written, role, type_):
    (one,) = node_of(f"auto a = {written};").endpoints
    assert (one.role.value, one.name.known, one.type.known) == (role, "a", type_)
    assert role == "service_client" or one.qos.depth == 3
