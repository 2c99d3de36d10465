"""What is shared by name or by reference is changed for all that hold it."""

import pytest

from roslens.source.extract.units.node_units import facts_of_main, facts_of_module

CPP = "#include <rclcpp/rclcpp.hpp>\n#include <std_msgs/msg/string.hpp>\n"
TWO = """
import rclpy
from copy import copy, deepcopy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
{before}
class A(Node):
    def __init__(self, {parameter}):
        super().__init__('a')
        {change}
        self.create_publisher(String, 'a', {given})
class B(Node):
    def __init__(self, {parameter}):
        super().__init__('b')
        self.create_publisher(String, 'b', {given})
def main():
    rclpy.init()
    {local}
    a = A({first})
    b = B({second})
main()
"""


def of_two(before="", local="pass", parameter="qos=None", given="qos", first="", second="", change=""):
    change = change or f"{given}.reliability = ReliabilityPolicy.BEST_EFFORT"
    return TWO.format(**locals())


def reliability(facts):
    return {str(one.name): one.endpoints[0].qos.reliability for one in facts if one.endpoints}


@pytest.mark.parametrize(
    ("text", "second"),
    [
        (of_two(before="QOS = QoSProfile(depth=1)", given="QOS"), "best_effort"),
        (of_two(before="class P:\n    qos = QoSProfile(depth=1)", given="P.qos"), "best_effort"),
        (of_two(local="q = QoSProfile(depth=1)", first="q", second="q"), "best_effort"),
        (of_two(local="q = QoSProfile(depth=1)", first="qos=q", second="qos=q"), "best_effort"),
        (of_two(local="q = QoSProfile(depth=1)", first="copy(q)", second="q"), "reliable"),
        (of_two(local="q = QoSProfile(depth=1)", first="deepcopy(q)", second="q"), "reliable"),
        (of_two(local="q, r = QoSProfile(depth=1), QoSProfile(depth=1)", first="q", second="r"), "reliable"),
        (of_two(local="q, r = QoSProfile(), QoSProfile()", first="q", second="r"), "reliable"),
    ],
)
def test_two_nodes_of_python_share_what_one_of_them_changes(index_of, text, second):
    facts = facts_of_module(index_of(a_py=text), "pkg/a.py")
    assert reliability(facts) == {"a": "best_effort", "b": second}


def test_what_is_shared_and_may_be_changed_is_unknown(index_of):
    change = "if far():\n            QOS.reliability = ReliabilityPolicy.BEST_EFFORT"
    text = of_two(before="QOS = QoSProfile(depth=1)", given="QOS", change=change)
    (other,) = [one for one in facts_of_module(index_of(a_py=text), "pkg/a.py") if str(one.name) == "b"]
    assert "may be changed, if far()" in other.endpoints[0].qos_unknown


NODE = """
class {name} : public rclcpp::Node {{ public:
  {name}({parameter}) : Node("{low}"){initialiser} {{ {change}
    create_publisher<std_msgs::msg::String>("{low}", {given}); }}
  {member} }};
"""


def of_cpp(parameter, given, first="q", second="q", initialiser="", member="", before="", local="rclcpp::QoS q(10);"):
    parts = [
        NODE.format(
            name=name,
            low=name.lower(),
            parameter=parameter,
            initialiser=initialiser,
            given=given,
            member=member,
            change=f"{given}.best_effort();" if name == "A" else "",
        )
        for name in "AB"
    ]
    main = f"int main() {{ {local} auto a = std::make_shared<A>({first}); auto b = std::make_shared<B>({second}); }}"
    return "\n".join((CPP, before, *parts, main))


@pytest.mark.parametrize(
    ("text", "second"),
    [
        (of_cpp("", "shared", "", "", before="static rclcpp::QoS shared(10);", local=""), "best_effort"),
        (of_cpp("rclcpp::QoS & q", "q"), "best_effort"),
        (of_cpp("rclcpp::QoS q", "q"), "reliable"),
        (of_cpp("rclcpp::QoS & q", "q_", initialiser=", q_(q)", member="rclcpp::QoS & q_;"), "best_effort"),
        (of_cpp("rclcpp::QoS & q", "q_", initialiser=", q_(q)", member="rclcpp::QoS q_;"), "reliable"),
    ],
)
def test_two_nodes_of_cpp_share_what_is_given_by_reference(index_of, text, second):
    assert reliability(facts_of_main(index_of(a_cpp=text), "pkg/a.cpp")) == {"a": "best_effort", "b": second}
