"""Names out of lists, in Python."""

import pytest


def names_of(units, *lines):
    text = """
import sys
from rclpy.node import Node
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a')
        self.p = self.declare_parameter('p', ['x', 'y']).value
        self.q = self.declare_parameter('q').value
"""
    (facts,) = units(a_py=text + "".join(f"        {line}\n" for line in lines))
    return [str(one.name) for one in facts.endpoints]


@pytest.mark.parametrize(
    ("over", "found"),
    [
        ("['x', 'y']", ["t/x", "t/y"]),
        ("sorted(['y', 'x'])", ["t/x", "t/y"]),
        ("reversed(['y', 'x'])", ["t/x", "t/y"]),
        ("list(('x', 'y'))", ["t/x", "t/y"]),
        ("range(2)", ["t/0", "t/1"]),
        ("range(1, 3)", ["t/1", "t/2"]),
        ("range(500)", ["t/{a number}"]),
        ("range(len(self.p))", ["t/{a number}"]),
        ("self.p", ["t/{each of parameter p}"]),
        ("sorted(set(self.p))", ["t/{each of parameter p}"]),
        ("[one + 's' for one in self.p]", ["t/{each of parameter p}s"]),
        ("self.q", ["t/{each of parameter q}"]),
    ],
)
def test_a_loop_over(units, over, found):
    assert names_of(units, f"for n in {over}:", "    self.create_publisher(String, f't/{n}', 1)") == found


@pytest.mark.parametrize(
    ("over", "found"),
    [
        ("enumerate(['x', 'y'])", ["t/0/x", "t/1/y"]),
        ("enumerate(['x', 'y'], start=1)", ["t/1/x", "t/2/y"]),
        ("enumerate(self.p)", ["t/{a number}/{each of parameter p}"]),
        ("zip(['a', 'b', 'c'], ['x', 'y'])", ["t/a/x", "t/b/y"]),
        ("zip(['a', 'b'], self.p)", ["t/{an item of a list}/{each of parameter p}"]),
        ("zip(self.q, self.p)", ["t/{each of parameter q}/{each of parameter p}"]),
    ],
)
def test_a_loop_over_pairs(units, over, found):
    assert names_of(units, f"for n, m in {over}:", "    self.create_publisher(String, f't/{n}/{m}', 1)") == found


def test_a_loop_that_counts_what_a_parameter_lists(units):
    lines = ("for n in range(len(self.p)):", "    self.create_publisher(String, self.p[n], 1)")
    assert names_of(units, *lines) == ["{each of parameter p}"]


def test_an_item_of_a_list_that_is_a_parameter(units):
    assert names_of(units, "self.create_publisher(String, self.p[1], 1)") == ["{item 1 of parameter p}"]


def test_a_list_that_is_filled(units):
    lines = ("names = list()", "names.append('x')", "for n in names:", "    self.create_publisher(String, n, 1)")
    assert names_of(units, *lines) == ["x"]


def test_parameters_that_a_list_names(units):
    text = """
from rclpy.node import Node
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a')
        for name in self.declare_parameter('p', ['x', 'y']).value:
            self.declare_parameter(name + '.topic', f'/{name}/scan')
            self.create_publisher(String, self.get_parameter(name + '.topic').value, 1)
"""
    (facts,) = units(a_py=text)
    (hole,) = facts.endpoints[0].name.holes
    assert (str(hole.reason), hole.parameter, hole.default) == (
        "parameter {each of parameter p}.topic",
        "*.topic",
        None,
    )
    assert [str(one) for one in hole.named] == ["{each of parameter p}.topic", "/{each of parameter p}/scan"]


def test_parameters_that_a_list_names_in_cpp(node_of):
    body = """auto names = declare_parameter("p", std::vector<std::string>{"x", "y"});
    for (const auto & name : names) {
      declare_parameter(name + ".topic", "/scan");
      pub_ = create_publisher<std_msgs::msg::String>(get_parameter(name + ".topic").as_string(), 1);
    }"""
    (hole,) = node_of(body).endpoints[0].name.holes
    assert (hole.parameter, hole.default, [str(one) for one in hole.named][:1]) == (
        "*.topic", "/scan", ["{each of parameter p}.topic"],
    )  # fmt: skip
    assert hole.named[0].holes[0].among == "[x, y]"


def test_a_list_of_another_node_is_none_of_this_one(units):
    text = """
import rclpy
from std_msgs.msg import String
def main():
    one = rclpy.create_node('one')
    two = rclpy.create_node('two')
    for name in one.declare_parameter('p', ['x']).value:
        two.create_publisher(String, name, 1)
    for name in two.declare_parameter('q', ['y']).value:
        two.create_publisher(String, name, 1)
        one.create_publisher(String, name, 1)
if __name__ == '__main__':
    main()
"""
    one, two = (facts for facts in units(a_py=text) if facts.unit == "<module>")
    assert [(str(hole.reason), hole.parameter) for end in two.endpoints for hole in end.name.holes] == [
        ("each of parameter p", ""), ("each of parameter q", "q"),
    ]  # fmt: skip
    assert [str(end.name) for end in one.endpoints] == ["{each of parameter q of node no. 1}"]


def test_vectors_of_cpp_that_may_be_filled_are_not_taken_for_empty(node_of, names):
    body = """
std::vector<std::string> given{"a", "b"};
for (auto & one : given) { create_client<std_srvs::srv::Trigger>(one); }
std::vector<std::string> filled;
fill(filled);
for (auto & one : filled) { create_client<std_srvs::srv::Trigger>(one); }
"""
    assert [name for _, name in names(node_of(body))][:2] == ["a", "b"]
    assert len(node_of(body).endpoints) == 3
