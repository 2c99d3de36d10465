import pytest


@pytest.mark.parametrize(
    ("written", "name"),
    [
        ("int('3')", "t/3"),
        ("int(3.7)", "t/3"),
        ("int('three')", "t/{result of int()}"),
        ("float('2')", "t/2.0"),
        ("float()", "t/0.0"),
        ("int('ff', 16)", "t/{result of int()}"),
        ("int(self.declare_parameter('n', 4).value)", "t/{parameter n}"),
    ],
)
def test_numbers_of_python(units, written, name):
    text = f"""
from rclpy.node import Node
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a')
        self.create_publisher(String, f't/{{{written}}}', 1)
"""
    (facts,) = units(a_py=text)
    assert [str(one.name) for one in facts.endpoints] == [name]


def test_numbers_of_cpp(node_of):
    body = 'pub_ = create_publisher<std_msgs::msg::String>("t" + std::to_string(std::stoi("7")), 1);'
    assert [str(one.name) for one in node_of(body).endpoints] == ["t7"]
