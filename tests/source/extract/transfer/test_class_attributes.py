"""Attributes of classes of Python that code sets for all that read them."""

import pytest

BEFORE = """
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
class Config:
    topic = 'a'
    other = 'o'
    quality = QoSProfile(depth=1)
    @classmethod
    def begin(cls):
        cls.topic = 'b'
def begin():
    Config.topic = 'b'
class A(Node):
    topic = 'a'
    def __init__(self):
        super().__init__('a')
"""


@pytest.fixture
def node(units):
    """Return the node A whose constructor has these lines."""

    def make(lines, after=""):
        text = BEFORE + "".join(f"        {line}\n" for line in lines.split("\n")) + after
        return next(one for one in units(a_py=text) if one.unit == "A")

    return make


def topic(facts):
    return facts.endpoints[-1].name


@pytest.mark.parametrize(
    ("lines", "given"),
    [
        ("Config.topic = 'b'", "Config.topic"),
        ("begin()", "Config.topic"),
        ("Config.begin()", "Config.topic"),
        ("setattr(Config, 'topic', 'b')", "Config.topic"),
        ("c = Config()\nConfig.topic = 'b'", "c.topic"),
        ("Config.topic = 'b'\nc = Config()", "c.topic"),
        ("A.topic = 'b'", "self.topic"),
        ("self.__class__.topic = 'b'", "self.topic"),
    ],
)
def test_what_is_set_holds_from_then_on(node, lines, given):
    assert topic(node(f"{lines}\nself.create_publisher(String, {given}, 1)")).known == "b"


def test_what_is_set_under_a_condition_is_the_one_or_the_other(node):
    found = topic(node("if x():\n    Config.topic = 'b'\nself.create_publisher(String, Config.topic, 1)"))
    assert found.known is None


def test_what_another_function_may_have_set_is_unknown(node):
    found = node("self.create_publisher(String, Config.topic, 1)")
    assert topic(found).known is None
    assert "set for all" in str(topic(found))


def test_what_nobody_sets_is_what_the_class_says(node):
    assert topic(node("self.create_publisher(String, Config.other, 1)")).known == "o"


def test_a_quality_of_service_that_is_set_elsewhere_is_not_certain(node):
    after = "def change():\n    Config.quality = QoSProfile(depth=5)\n"
    (one,) = node("self.create_publisher(String, 'a', Config.quality)", after).endpoints
    assert one.qos_unknown


def test_an_object_keeps_what_is_its_own(node):
    lines = "c = Config()\nc.other = 'own'\nConfig.other = 'b'\nself.create_publisher(String, c.other, 1)"
    assert topic(node(lines)).known == "own"
