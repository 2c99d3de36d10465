"""Variables of modules of Python that more than one statement makes."""

import pytest

from roslens.source.extract.symbolic.condition import as_written

HEAD = """
from rclpy.node import Node
from std_msgs.msg import String
from outside import ask

{}

class Main(Node):
    def __init__(self):
        super().__init__("main")
        for one in NAMES:
            self.create_publisher(String, one, 1)

class Other:
    NAMES = ["z"]
"""


@pytest.mark.parametrize(
    ("module", "told"),
    [
        ("NAMES = [f'{one}_raw' for one in ('a', 'b')]", [("a_raw", ()), ("b_raw", ())]),
        ("NAMES = ['a']\nNAMES.append('b')", [("a", ()), ("b", ())]),
        ("NAMES = ['a']\nNAMES += ['b']", [("a", ()), ("b", ())]),
        ("NAMES = ['a']\nNAMES = ['b']", [("b", ())]),
        ("NAMES = []\nfor one in 'a', 'b':\n    NAMES.append(one)", [("a", ()), ("b", ())]),
        ("NAMES = ['a']\nif ask():\n    NAMES.append('b')", [("a", ()), ("b", ("ask()",))]),
        ("NAMES = ['a']\nprint(NAMES)", [("a", ())]),
    ],
)
def test_what_a_module_makes_of_a_variable(units, module, told):
    (found,) = units(main_py=HEAD.format(module))
    assert [(one.name.known, as_written(one.conditions)) for one in found.endpoints] == told
