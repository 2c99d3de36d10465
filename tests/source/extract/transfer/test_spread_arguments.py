"""Arguments that are spread out, where they are known and where they are not."""

import pytest

HEAD = """
from rclpy.node import Node
from std_msgs.msg import String
from outside import words, options

def join(first, second="s", third="t"):
    return first + second + third

class Main(Node):
    def __init__(self):
        super().__init__("main")
        self.create_publisher(String, {}, 1)
"""


@pytest.mark.parametrize(
    ("call", "name"),
    [
        ("join(*['a', 'b'])", "abt"),
        ("join('a', *['b', 'c'])", "abc"),
        ("join(*['a'], **{'third': 'z'})", "asz"),
        ("join('a', *words())", None),
        ("join(*words())", None),
        ("join('a', **options())", None),
        ("join('a', 'b', 'c', **options())", "abc"),
    ],
)
def test_arguments_that_are_spread_out(units, call, name):
    (found,) = units(main_py=HEAD.format(call))
    assert [one.name.known for one in found.endpoints] == [name]
