"""Which functions of a Python file are registered as callbacks, and what they reach by calls."""

import time

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.callbacks import function_name
from roslens.source.rules.flow.python_callbacks import python_callbacks
from roslens.source.settings import MacroSettings

NODE = """
import rclpy
class Arm(Base):
    def __init__(self):
        {registers}
    def a(self, *rest):
        self.b()
    def b(self):
        self.c()
    def c(self):
        here = 1
    @staticmethod
    def apart(message):
        pass
"""


def callbacks(registers, extra=""):
    code = NODE.format(registers=registers.replace("\n", "\n        ")) + extra
    view = parse_file(code.encode(), Language.PYTHON, MacroSettings()).view()
    return python_callbacks(view), view


def registered(registers, extra=""):
    found, view = callbacks(registers, extra)
    functions = [] if found is None else [one.target.function for one in found.registrations]
    return sorted("lambda" if one.type == "lambda" else function_name(one, view) for one in functions)


@pytest.mark.parametrize(
    ("registers", "expected"),
    [
        ("self.create_timer(1.0, self.a)", ["Arm.a"]),
        ("self.create_timer(timer_period_sec=1.0, callback=self.a)", ["Arm.a"]),
        ("self.create_timer(1.0, lambda: self.a())", ["lambda"]),
        ("self.create_subscription(T, 't', functools.partial(self.a, 1), 10)", ["Arm.a"]),
        ("callback = self.a\nself.create_timer(1.0, callback)", ["Arm.a"]),
        ("self.tick = self.a\nself.create_timer(1.0, self.tick)", ["Arm.a"]),
        ("for each in (self.a, self.b):\n    self.create_timer(1.0, each)", ["Arm.a", "Arm.b"]),
        ("for t, each in [('a', self.a), ('b', self.b)]:\n    self.create_timer(1.0, each)", ["Arm.a", "Arm.b"]),
        ("d = {'a': self.a, 'b': self.b}\nself.create_timer(1.0, d[name])", ["Arm.a", "Arm.b"]),
        ("for t, each in {'a': self.a}.items():\n    self.create_timer(1.0, each)", ["Arm.a"]),
        ("self.create_timer(1.0, self.a if fast else self.b)", ["Arm.a", "Arm.b"]),
        ("def inner():\n    pass\nself.create_timer(1.0, inner)", ["inner"]),
        ("self.create_timer(1.0, self.unknown)", []),
        ("self.create_timer(1.0, made())", []),
        ("threading.Timer(1.0, self.a)", []),
        ("ActionServer(self, T, 'n', self.a, cancel_callback=self.b)", ["Arm.a", "Arm.b"]),
        ("self.helper = Helper()\nself.create_timer(1.0, self.helper.go)", ["Helper.go"]),
    ],
)
def test_what_is_handed_over_is_followed(registers, expected):
    extra = "class Helper:\n    def go(self):\n        pass\n"
    assert registered(registers, extra) == expected


def test_a_method_is_bound_and_a_static_one_is_not():
    found, _ = callbacks("self.create_timer(1.0, self.a)\nself.create_timer(1.0, self.apart)")
    assert [(one.target.bound, one.target.is_exact) for one in found.registrations] == [(1, True), (0, True)]


def test_an_inherited_method_is_followed():
    assert registered("self.create_timer(1.0, self.old)", "class Base:\n    def old(self):\n        pass\n") == [
        "Base.old"
    ]


def test_the_way_names_each_function_once():
    found, view = callbacks("self.create_timer(1.0, lambda: self.a())")
    inner = view.node_at(view.source.find(b"here"), view.source.find(b"here") + 4)
    (way,) = found.ways_to(inner)
    assert [one.type == "lambda" or function_name(one, view) for one in way.functions] == [
        True,
        "Arm.a",
        "Arm.b",
        "Arm.c",
    ]


def test_functions_that_call_each_other_end():
    found, _ = callbacks(
        "self.create_timer(1.0, self.x)", "    def x(self):\n        self.y()\n    def y(self):\n        self.x()\n"
    )
    assert len(found.registrations) == 1


def test_a_file_that_registers_nothing_is_not_read():
    view = parse_file(b"import rclpy\nrclpy.init()\n", Language.PYTHON, MacroSettings()).view()
    assert python_callbacks(view) is None


def test_names_that_stand_for_each_other_end_at_once():
    code = "\n".join(["import rclpy", *("a = b\nb = c\nc = a" for _ in range(60)), "node.create_timer(1.0, a)"])
    view = parse_file(code.encode(), Language.PYTHON, MacroSettings()).view()
    started = time.process_time()
    found = python_callbacks(view)
    assert found is not None
    assert found.registrations == ()
    assert time.process_time() - started < 1.0
