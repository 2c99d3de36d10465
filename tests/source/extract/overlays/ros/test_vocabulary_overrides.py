"""Which policies parameters may set, as code writes it."""

import pytest

from roslens.source.extract.facts.node_facts import Overrides
from roslens.source.extract.symbolic.text import Written

USUAL = ("history", "depth", "reliability")
PYTHON = """
from rclpy.node import Node
from rclpy.qos import QoSPolicyKind
from rclpy.qos_overriding_options import QoSOverridingOptions
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_publisher(String, 'a', 10, qos_overriding_options={})
"""


@pytest.mark.parametrize(
    ("written", "overrides"),
    [
        ("QoSOverridingOptions.with_default_policies()", Overrides(USUAL)),
        ("QoSOverridingOptions.with_default_policies(entity_id='x')", Overrides(USUAL, "x")),
        ("QoSOverridingOptions([QoSPolicyKind.DEPTH])", Overrides(("depth",))),
        (
            "QoSOverridingOptions((QoSPolicyKind.LIVELINESS_LEASE_DURATION,), callback=print, entity_id='x')",
            Overrides(("liveliness_lease_duration",), "x"),
        ),
        ("None", None),
    ],
)
def test_of_rclpy(units, written, overrides):
    (facts,) = units(a_py=PYTHON.format(written))
    (one,) = facts.endpoints
    assert one.overrides == overrides
    assert (one.qos.reliability, one.qos.depth, one.qos_unknown) == ("reliable", 10, "")


@pytest.mark.parametrize(
    ("written", "overrides"),
    [
        ("rclcpp::QosOverridingOptions::with_default_policies()", Overrides(USUAL)),
        ('rclcpp::QosOverridingOptions::with_default_policies(nullptr, "x")', Overrides(USUAL, "x")),
        ("rclcpp::QosOverridingOptions({rclcpp::QosPolicyKind::Depth})", Overrides(("depth",))),
        (
            'rclcpp::QosOverridingOptions{{QosPolicyKind::Depth, QosPolicyKind::Durability}, [](auto) { f(); }, "x"}',
            Overrides(("depth", "durability"), "x"),
        ),
        ("{rclcpp::QosPolicyKind::Depth, rclcpp::QosPolicyKind::Reliability}", Overrides(("depth", "reliability"))),
    ],
)
@pytest.mark.parametrize("declared", ["rclcpp::PublisherOptions o;", "auto o = rclcpp::PublisherOptions();"])
def test_of_rclcpp(node_of, written, overrides, declared):
    body = f"{declared} o.qos_overriding_options = {written};\n"
    (one,) = node_of(body + 'pub_ = create_publisher<std_msgs::msg::String>("a", 3, o);').endpoints
    assert one.overrides == overrides


def test_of_a_subscription_of_rclcpp(node_of):
    body = "rclcpp::SubscriptionOptions o; o.qos_overriding_options = rclcpp::QosOverridingOptions({});\n"
    take = "[](std_msgs::msg::String::SharedPtr m) { take(m); }"
    (one,) = node_of(body + f'sub_ = create_subscription<std_msgs::msg::String>("a", 3, {take}, o);').endpoints
    assert one.overrides == Overrides(())


def test_options_that_say_nothing_of_it(node_of):
    body = "rclcpp::PublisherOptions o;\n"
    (one,) = node_of(body + 'pub_ = create_publisher<std_msgs::msg::String>("a", 3, o);').endpoints
    assert one.overrides is None


def test_what_is_not_known_is_said(node_of):
    body = "rclcpp::PublisherOptions o; o.qos_overriding_options = rclcpp::QosOverridingOptions(kinds_of_mine());\n"
    (one,) = node_of(body + 'pub_ = create_publisher<std_msgs::msg::String>("a", 3, o);').endpoints
    assert one.overrides is not None
    assert "it is unknown" in one.overrides.unknown


def test_under_a_condition(node_of):
    body = """rclcpp::PublisherOptions o; bool allow = ask();
    if (allow) { o.qos_overriding_options = rclcpp::QosOverridingOptions::with_default_policies(); }
    pub_ = create_publisher<std_msgs::msg::String>("a", 3, o);"""
    (one,) = node_of(body).endpoints
    assert one.overrides == Overrides(USUAL, conditions=(Written("allow"),))
    assert one.conditions == ()
