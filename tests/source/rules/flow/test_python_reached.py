"""A wait in one file is told where a callback of another file calls the function that waits."""

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.callbacks import callbacks_of
from roslens.source.rules.flow.python_reached import reached_facts
from roslens.source.rules.match_file import match_file
from roslens.source.rules.place_hits import place_hits
from roslens.source.rules.table import native_rules
from roslens.source.settings import MacroSettings

BASE = """
import rclpy

class Asking(Node):
    def __init__(self):
        self.client = self.create_client(Trigger, "open")
    def ask(self):
        return self.request(1)
    def request(self, what):
        return self.client.call(what)

class Opener:
    def __init__(self, node):
        self.node = node
        self.client = node.create_client(Trigger, "open")
    def open(self):
        rclpy.spin_until_future_complete(self.node, self.client.call_async(1))
    def close(self):
        rclpy.spin_until_future_complete(self.node, self.client.call_async(1))
"""
NODE = """
import rclpy
from base import Asking, Opener

class Gate(Asking):
    def __init__(self):
        self.opener = Opener(self)
        self.create_timer(1.0, self.on_tick{group})
    def on_tick(self):
        {calls}
"""


def view_of(code):
    return parse_file(code.encode(), Language.PYTHON, MacroSettings()).view()


def lines_found(calls, group=""):
    views = {"base.py": view_of(BASE), "node.py": view_of(NODE.format(calls=calls, group=group))}
    hits = {path: match_file(view).hits for path, view in views.items()}
    facts = [one for view in views.values() for one in (*callbacks_of(view), *reached_facts(view))]
    ids = ("node.call_in_callback_python", "node.spin_in_callback_python")
    rules = native_rules()
    found = place_hits(hits, facts, {one: rules[one].severity for one in ids}, rules, ())
    return [(one.path, one.line, one.rule) for one in found]


@pytest.mark.parametrize(
    ("calls", "expected"),
    [
        ("self.ask()", [("base.py", 10, "node.call_in_callback_python")]),
        ("self.opener.open()", [("base.py", 17, "node.spin_in_callback_python")]),
        ("self.opener.unknown()", []),
        ("pass", []),
    ],
)
def test_what_a_callback_calls_in_another_file_is_told_there(calls, expected):
    assert lines_found(calls) == expected


def test_a_callback_in_a_group_of_its_own_is_left_out():
    assert lines_found("self.ask()", ", callback_group=ReentrantCallbackGroup()") == []


def test_what_is_handed_over_from_a_base_class_is_reached():
    assert "reached Asking.old" in reached_facts(
        view_of(NODE.format(calls="pass", group="").replace("self.on_tick", "self.old"))
    )


def test_a_file_without_callbacks_reaches_nothing():
    assert reached_facts(view_of(BASE)) == ()
