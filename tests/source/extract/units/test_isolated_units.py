"""One unit that breaks its evaluation does not lose the others."""

from __future__ import annotations

import pytest

from roslens.source.extract.facts.node_facts import Evidence, Target, TargetKind
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.symbols.symbol_table import SymbolTable
from roslens.source.extract.units import isolated_units, node_units
from roslens.source.extract.units.isolated_units import units_of
from roslens.source.extract.units.workspace_units import facts_of_workspace

TALK = b"""import rclpy
from rclpy.node import Node
class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.create_publisher(String, 'chatter', 10)
def begin():
    rclpy.init()
    node = rclpy.create_node('begun')
    node.create_publisher(String, 'other', 10)
"""
HEAR = b"""import rospy
rospy.init_node('hearer')
rospy.Subscriber('chatter', String, print)
"""


@pytest.fixture
def index() -> SymbolTable:
    contents = {"a/talk.py": TALK, "b/hear.py": HEAR}
    return indexed({path: program_of_python(content) for path, content in contents.items()})


def started(entry: str) -> Target:
    return Target(TargetKind.EXECUTABLE, "a", "talk", ("a/talk.py",), Evidence("a/setup.py", 1), entry)


def test_without_a_fault_it_is_what_the_workspace_has(index: SymbolTable):
    units = units_of(index, [])
    assert list(units.facts) == facts_of_workspace(index)
    assert {str(one.name) for one in units.facts if one.name.parts} == {"talker", "hearer", "begun"}
    assert units.failures == ()


def test_functions_that_targets_start_are_units_too(index: SymbolTable):
    units = units_of(index, [started("talk:begin"), started("talk:begin"), started("talk:nowhere")])
    assert [str(one.name) for one in units.facts].count("begun") == 1
    assert units_of(index, [started("a.talk:begin"), started("")]).facts


def test_what_nothing_starts_is_told(index: SymbolTable):
    (told,) = [one for one in units_of(index, []).facts if one.kind == "function"]
    assert (told.unit, told.path, told.line) == ("begin", "a/talk.py", 7)
    assert "function" not in {one.kind for one in units_of(index, [started("talk:begin")]).facts}


def test_of_a_fault_the_unit_is_told_and_the_others_stay(index: SymbolTable, monkeypatch: pytest.MonkeyPatch):
    plain = units_of(index, []).facts
    of_module = node_units.facts_of_module

    def breaking(
        index: SymbolTable, path: str, function: str = "", reached: node_units.Reached | None = None
    ) -> object:
        if path == "b/hear.py":
            raise TypeError("unhashable")
        return of_module(index, path, function, reached)

    monkeypatch.setattr(isolated_units, "facts_of_workspace", lambda index, _: breaking(index, "b/hear.py"))
    monkeypatch.setattr(isolated_units, "facts_of_module", breaking)
    units = units_of(index, [])
    assert list(units.facts) == [one for one in plain if one.path != "b/hear.py"] != []
    assert [(one.location and one.location.path, one.what) for one in units.failures] == [
        ("b/hear.py", "TypeError: unhashable")
    ]
    assert all(one.partial and one.detail and one.advice for one in units.failures)


def test_one_by_one_finds_the_same(index: SymbolTable, monkeypatch: pytest.MonkeyPatch):
    plain = units_of(index, [])

    def breaking(_: SymbolTable, reached: node_units.Reached) -> object:
        reached.add(("a/talk.py", 7))  # nothing is taken as followed because of what broke
        raise RuntimeError

    monkeypatch.setattr(isolated_units, "facts_of_workspace", breaking)
    assert units_of(index, []) == plain
