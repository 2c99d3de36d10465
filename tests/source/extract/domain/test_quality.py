"""Quality of service that is changed after it was made, or one of several."""

import pytest

LATCHED = """static const rmw_qos_profile_t own_latched = {
  RMW_QOS_POLICY_HISTORY_KEEP_LAST, 1, RMW_QOS_POLICY_RELIABILITY_RELIABLE, RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL,
  RMW_QOS_DEADLINE_DEFAULT, RMW_QOS_LIFESPAN_DEFAULT, RMW_QOS_POLICY_LIVELINESS_SYSTEM_DEFAULT,
  RMW_QOS_LIVELINESS_LEASE_DURATION_DEFAULT, false};
"""
FROM = "rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(q), q)"
PYTHON = """
from copy import copy, deepcopy
from rclpy.node import Node
from rclpy.qos import (QoSProfile, qos_profile_sensor_data, qos_profile_services_default, ReliabilityPolicy,
    DurabilityPolicy, QoSPresetProfiles)
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a')
"""


def policies(one):
    return one.qos.reliability, one.qos.durability, one.qos.history, one.qos.depth


def published(node_of, lines, given="q", **more):
    (one,) = node_of(f'{lines}\npub_ = create_publisher<std_msgs::msg::String>("a", {given});', **more).endpoints
    return one


@pytest.mark.parametrize(
    ("lines", "quality"),
    [
        (
            "rclcpp::QoS q(10); q.best_effort(); q.transient_local();",
            ("best_effort", "transient_local", "keep_last", 10),
        ),
        ("auto q = rclcpp::QoS(1); q.keep_all().best_effort();", ("best_effort", "volatile", "keep_all", 1)),
        ("rclcpp::QoS q(3); q.keep_last(4);", ("reliable", "volatile", "keep_last", 4)),
        ("rclcpp::QoS q(3); auto r = q; r.best_effort();", ("reliable", "volatile", "keep_last", 3)),
        (
            "rclcpp::QoS q(3); q.reliability(RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT);",
            ("best_effort", "volatile", "keep_last", 3),
        ),
        (
            "rclcpp::QoS q(3); q.get_rmw_qos_profile().durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;",
            ("reliable", "transient_local", "keep_last", 3),
        ),
        (
            "auto last = RMW_QOS_POLICY_HISTORY_KEEP_LAST; rclcpp::QoS q({last, 7}, rmw_qos_profile_sensor_data);",
            ("best_effort", "volatile", "keep_last", 7),
        ),
        (
            "auto q = rclcpp::QoS({RMW_QOS_POLICY_HISTORY_KEEP_LAST, 7}, rmw_qos_profile_sensor_data);",
            ("best_effort", "volatile", "keep_last", 7),
        ),
    ],
)
def test_what_was_changed_after_it_was_made(node_of, lines, quality):
    one = published(node_of, lines)
    assert (policies(one), one.qos_unknown) == (quality, "")


def test_a_profile_of_the_middleware_that_is_changed(node_of):
    lines = "rmw_qos_profile_t q = rmw_qos_profile_default; q.depth = 3;\n"
    lines += "q.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;"
    one = published(node_of, lines, FROM)
    assert (policies(one), one.qos_unknown) == (("reliable", "transient_local", "keep_last", 3), "")


@pytest.mark.parametrize("held", ["auto q = own_latched;", "rmw_qos_profile_t q = own_latched;"])
def test_a_profile_of_the_middleware_that_is_written_out(units, held):
    body = f'{held}\npub_ = create_publisher<std_msgs::msg::String>("a", {FROM});'
    code = (
        f'#include <rclcpp/rclcpp.hpp>\n{LATCHED}class A : public rclcpp::Node {{\n  A() : Node("a") {{ {body} }}\n}};'
    )
    (facts,) = units(a_cpp=code)
    assert policies(facts.endpoints[0]) == ("reliable", "transient_local", "keep_last", 1)


def test_what_a_function_changes_by_reference(units):
    code = """#include <rclcpp/rclcpp.hpp>
void latch(rclcpp::QoS & q) { q.transient_local(); }
class A : public rclcpp::Node {
  A() : Node("a") {
    rclcpp::QoS q(1);
    latch(q);
    pub_ = create_publisher<std_msgs::msg::String>("a", q);
  }
};"""
    (facts,) = units(a_cpp=code)
    assert policies(facts.endpoints[0]) == ("reliable", "transient_local", "keep_last", 1)


@pytest.mark.parametrize(
    ("lines", "quality"),
    [
        ("rclcpp::QoS q(5); if (flag()) q.transient_local();", ("reliable", "", "keep_last", 5)),
        ("rclcpp::QoS q(5); if (flag()) { q = rclcpp::SensorDataQoS(); }", ("", "volatile", "keep_last", 5)),
        (
            "auto q = flag() ? rclcpp::QoS(5).transient_local() : rclcpp::SensorDataQoS();",
            ("", "", "keep_last", 5),
        ),
        ("rclcpp::QoS q(5); q.reliability(outside());", ("", "volatile", "keep_last", 5)),
        ("rclcpp::QoS q(5); q.keep_last(outside());", ("reliable", "volatile", "keep_last", 0)),
        ("rclcpp::QoS q(get_qos());", ("", "", "", 0)),
        ("auto r = outside(); rclcpp::QoS q(rclcpp::KeepLast(2), r);", ("", "", "keep_last", 2)),
    ],
)
def test_what_is_one_of_several_is_not_known(node_of, lines, quality):
    one = published(node_of, lines)
    assert policies(one) == quality
    assert one.qos_unknown


def test_one_of_the_qualities_that_a_function_returns(units):
    code = """#include <rclcpp/rclcpp.hpp>
rmw_qos_profile_t named(std::string name) {
  if (name == "DEFAULT") return rmw_qos_profile_default;
  if (name == "SENSOR_DATA") return rmw_qos_profile_sensor_data;
  throw std::runtime_error(name);
}
class A : public rclcpp::Node {
  A() : Node("a") {
    auto known = named("SENSOR_DATA");
    a_ = create_publisher<std_msgs::msg::String>("a", rclcpp::QoS(rclcpp::KeepLast(1), known));
    auto open = named(declare_parameter("quality", "DEFAULT"));
    b_ = create_publisher<std_msgs::msg::String>("b", rclcpp::QoS(rclcpp::KeepLast(1), open));
  }
};"""
    (facts,) = units(a_cpp=code)
    first, second = facts.endpoints
    assert (first.qos.reliability, first.qos_unknown) == ("best_effort", "")
    assert (second.qos.reliability, bool(second.qos_unknown)) == ("", True)


def in_python(units, *lines):
    whole = PYTHON + "".join(f"        {line}\n" for line in (*lines, "self.create_publisher(String, 'a', q)"))
    (facts,) = units(a_py=whole)
    return facts.endpoints[0]


@pytest.mark.parametrize(
    ("lines", "quality"),
    [
        (
            ["q = QoSProfile(depth=1)", "q.durability = DurabilityPolicy.TRANSIENT_LOCAL"],
            ("reliable", "transient_local", "keep_last", 1),
        ),
        (
            ["q = qos_profile_sensor_data", "q.reliability = ReliabilityPolicy.RELIABLE", "q.depth = 7"],
            ("reliable", "volatile", "keep_last", 7),
        ),
        (
            ["q = QoSProfile(depth=1)", "r = q", "r.durability = DurabilityPolicy.TRANSIENT_LOCAL"],
            ("reliable", "transient_local", "keep_last", 1),
        ),
        (
            ["q = QoSProfile(depth=1)", "r = copy(q)", "r.durability = DurabilityPolicy.TRANSIENT_LOCAL"],
            ("reliable", "volatile", "keep_last", 1),
        ),
        (
            ["q = deepcopy(qos_profile_services_default)", "q.reliability = ReliabilityPolicy.BEST_EFFORT"],
            ("best_effort", "volatile", "keep_last", 10),
        ),
        (
            ["q = QoSProfile(depth=2)", "setattr(q, 'reliability', ReliabilityPolicy.BEST_EFFORT)"],
            ("best_effort", "volatile", "keep_last", 2),
        ),
        (
            ["q = QoSPresetProfiles.get_from_short_key('sensor_data')"],
            ("best_effort", "volatile", "keep_last", 5),
        ),
    ],
)
def test_what_was_changed_in_python(units, lines, quality):
    one = in_python(units, *lines)
    assert (policies(one), one.qos_unknown) == (quality, "")


def test_a_member_that_a_method_changes(units):
    lines = ["self.q = QoSProfile(depth=5)", "self.lossy()", "q = self.q"]
    lines += ["self.create_publisher(String, 'a', q)", "", "", "def lossy(self):"]
    text = PYTHON + "".join(f"        {line}\n" for line in lines[:4])
    text += "    def lossy(self):\n        self.q.reliability = ReliabilityPolicy.BEST_EFFORT\n"
    (facts,) = units(a_py=text)
    assert policies(facts.endpoints[0]) == ("best_effort", "volatile", "keep_last", 5)


@pytest.mark.parametrize(
    ("lines", "unknown"),
    [
        (
            ["q = QoSProfile(depth=5)", "if self.lossy():", "    q.reliability = ReliabilityPolicy.BEST_EFFORT"],
            "one of",
        ),
        (["q = 5 if self.lossy() else qos_profile_sensor_data"], "one of"),
        (["q = qos_profile_services_default", "q.reliability = self.reliability()"], "its reliability"),
        (["q = QoSPresetProfiles.get_from_short_key(self.key())"], "the preset"),
    ],
)
def test_what_is_open_in_python(units, lines, unknown):
    one = in_python(units, *lines)
    assert one.qos_unknown.startswith(unknown)
    assert one.qos.reliability == ""
