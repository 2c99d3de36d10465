"""Objects of classes whose constructor Python makes of their fields."""

PROGRAM = """
from dataclasses import dataclass
from typing import NamedTuple
from rclpy.node import Node
from std_msgs.msg import String

@dataclass
class Topic:
    name: str = "a"
    depth: int = 3

@dataclass
class Stamped(Topic):
    frame: str = "map"

class Pair(NamedTuple):
    first: str
    second: str = "z"

class Main(Node):
    def __init__(self, **options):
        super().__init__("main")
        for one in (Topic(), Topic("b", depth=4), Stamped("c", 5, "odom"), Topic(**options)):
            self.create_publisher(String, one.name, one.depth)
        self.create_publisher(String, Stamped("c", 5, "odom").frame, 1)
        pair = Pair("x")
        self.create_publisher(String, pair.first + pair.second, 1)
"""


def test_fields_are_what_is_given(units):
    (found,) = units(main_py=PROGRAM)
    told = [(one.name.known, one.qos.depth) for one in found.endpoints]
    assert told[:3] == [("a", 3), ("b", 4), ("c", 5)]
    assert told[-2:] == [("odom", 1), ("xz", 1)]
