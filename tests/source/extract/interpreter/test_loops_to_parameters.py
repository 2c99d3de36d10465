"""Loops that count up to a parameter: a name made of their number is one for each of them."""

import pytest

PYTHON = """
from rclpy.node import Node
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a')
        n = self.declare_parameter('n', 2).value
        for i in range({end}):
            self.create_publisher(String, {name}, 10)
"""
CPP = """
    const int n = declare_parameter<int>("n", 2);
    for ({loop}) {{ made_.push_back(create_publisher<std_msgs::msg::String>({name}, 10)); }}
"""
COUNTED = "image_{each number below parameter n}"


@pytest.mark.parametrize(
    ("end", "name", "expected"),
    [
        ("n", "f'image_{i}'", COUNTED),
        ("n", "'image_' + str(i)", COUNTED),
        ("n", "'image_%d' % i", COUNTED),
        ("n", "f'image_{i + 1}'", "image_{a sum}"),
        ("1, n", "f'image_{i}'", "image_{a number}"),
        ("ask()", "f'image_{i}'", "image_{a number}"),
    ],
)
def test_python(units, end, name, expected):
    (facts,) = [one for one in units(a_py=PYTHON.format(end=end, name=name)) if one.unit == "A"]
    assert [(str(one.name), one.conditions) for one in facts.endpoints] == [(expected, ())]


@pytest.mark.parametrize(
    ("loop", "name", "expected"),
    [
        ("int i = 0; i < n; ++i", '"image_" + std::to_string(i)', COUNTED),
        ("size_t i = 0; i != n; i++", '"image_" + std::to_string(i)', COUNTED),
        ("int i = 0; i < n; ++i", '"image_" + std::to_string(i + 1)', "image_{a sum}"),
        ("int i = 1; i < n; ++i", '"image_" + std::to_string(i)', "image_{i, which changes in a loop}"),
        ("int i = 0; i < n; i += 2", '"image_" + std::to_string(i)', "image_{i, which changes in a loop}"),
        ("int i = 0; i < ask(); ++i", '"image_" + std::to_string(i)', "image_{i, which changes in a loop}"),
    ],
)
def test_cpp(node_of, loop, name, expected):
    (one,) = node_of(CPP.format(loop=loop, name=name)).endpoints
    assert str(one.name) == expected
    assert bool(one.conditions) is (", which changes" in expected)
