"""Types and lists of which a condition chooses, and what is made in both ways."""

import pytest

PYTHON = """
from rclpy.node import Node
from std_msgs.msg import Int32, String
class A(Node):
    def __init__(self):
        super().__init__('a')
"""


def in_python(units, *lines):
    (facts,) = units(a_py=PYTHON + "".join(f"        {line}\n" for line in lines))
    return facts.endpoints


@pytest.mark.parametrize(
    "lines", [["T = String if self.x() else Int32"], ["T = Int32", "if self.x():", "    T = String"]]
)
def test_a_type_that_is_one_of_two_is_unknown(units, lines):
    (one,) = in_python(units, *lines, "self.create_publisher(T, 'a', 1)")
    assert one.type.known is None


def test_a_type_that_a_function_returns_one_of(units):
    function = "    def kind(self):\n        if self.x():\n            return String\n        return Int32\n"
    (facts,) = units(a_py=f"{PYTHON}        self.create_publisher(self.kind(), 'a', 1)\n{function}")
    assert facts.endpoints[0].type.known is None


@pytest.mark.parametrize(
    ("lines", "names"),
    [
        (["n = ['a', 'b']", "if self.other():", "    n = ['c']"], None),
        (["n = ['a']", "if self.other():", "    n = self.more()"], None),
        (["n = ['a']", "if self.more():", "    n = ['a', 'b']"], ["a", "b"]),
        (["n = ['a']", "if self.more():", "    n = ['b']"], None),
    ],
)
def test_a_list_that_is_one_of_two(units, lines, names):
    loop = ["for t in n:", "    self.create_publisher(String, t, 1)"]
    found = [str(one.name) for one in in_python(units, *lines, *loop)]
    assert found == names or (names is None and len(found) == 1 and "{" in found[0])
