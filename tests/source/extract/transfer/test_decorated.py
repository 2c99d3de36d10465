"""Functions that functions of the workspace decorate."""

BEFORE = """
from rclpy.node import Node
from std_msgs.msg import String

def before(function):
    def inner(*given):
        return "before_" + function(*given)
    return inner

def with_prefix(prefix):
    def decorate(function):
        return lambda *given: prefix + function(*given)
    return decorate

@before
def plain(name):
    return name

@with_prefix("p_")
@before
def both(name):
    return name

class Main(Node):
    def __init__(self):
        super().__init__("main")
        self.create_publisher(String, plain("a"), 1)
        self.create_publisher(String, both("b"), 1)
        self.create_publisher(String, self.name(), 1)

    @before
    def name(self):
        return "c"
"""


def test_what_a_decorator_returns_is_called(units):
    (found,) = units(main_py=BEFORE)
    assert [one.name.known for one in found.endpoints] == ["before_a", "p_before_b", None]


def test_decorators_from_elsewhere_hand_on_what_they_decorate(units):
    program = BEFORE.replace("@before\ndef plain", "@outside.before\ndef plain")
    (found,) = units(main_py=program)
    assert found.endpoints[0].name.known == "a"
