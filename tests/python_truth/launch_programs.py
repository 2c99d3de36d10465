"""Makes up Python launch files with conditions that nobody knows, executes them with stubs, and tells their nodes.

The unknown is ``ask()`` of the module ``outside``, as in nodes.
"""

from __future__ import annotations

import random
import sys
from types import ModuleType
from typing import Any

HEAD = """\
import copy

from launch import LaunchDescription
from launch_ros.actions import Node
from outside import ask


def generate_launch_description():
    nodes = []
    name = "first"
    names = ["a", "b"]
"""


class LaunchDescription(list):  # type: ignore[type-arg]
    """A description that holds its entities."""

    def add_action(self, action: Any) -> None:
        """Add an entity."""
        self.append(action)


def _node(**given: Any) -> str:
    return str(given["name"])


def run(program: str, seed: int) -> tuple[str, ...]:
    """Return the names of the nodes that a launch file starts in one run."""
    draw = random.Random(seed)
    stubs = {name: ModuleType(name) for name in ("launch", "launch_ros", "launch_ros.actions", "outside")}
    stubs["launch"].LaunchDescription = LaunchDescription  # type: ignore[attr-defined]
    stubs["launch_ros.actions"].Node = _node  # type: ignore[attr-defined]
    stubs["outside"].ask = lambda: bool(seed) if seed < 2 else draw.random() < 0.5  # type: ignore[attr-defined]
    before = {name: sys.modules.get(name) for name in stubs}
    sys.modules.update(stubs)
    try:
        names: dict[str, Any] = {}
        exec(compile(program, "made_up.launch.py", "exec"), names)
        return tuple(names["generate_launch_description"]())
    finally:
        for name, module in before.items():
            if module is None:
                del sys.modules[name]
            else:
                sys.modules[name] = module


class Maker:
    """Makes up the body of a launch file."""

    def __init__(self, seed: int) -> None:
        self.draw = random.Random(seed)
        self.loops = self.made = 0

    def node(self) -> str:
        """Return a node whose name nobody else has, or has that of a variable."""
        self.made += 1
        given = self.draw.choice((f'"n{self.made}"', f'f"n{self.made}_{{name}}"', f'f"n{self.made:02d}"'))
        return f'Node(package="p", executable="e", name={given})'

    def condition(self) -> str:
        """Return a condition."""
        return self.draw.choice(("ask()", "ask()", "True", 'name == "first"', 'not name.startswith("f")', "not ask()"))

    def block(self, deep: int) -> list[str]:
        """Return statements."""
        return [line for _ in range(self.draw.randrange(1, 4)) for line in self.statement(deep)]

    def inside(self, deep: int) -> list[str]:
        """Return statements, indented."""
        return [f"    {line}" for line in self.block(deep + 1)]

    def statement(self, deep: int) -> list[str]:
        """Return a statement."""
        chance = self.draw.random()
        if deep > 2 or chance < 0.4:
            return [self.draw.choice((f"nodes.append({self.node()})", f"nodes += [{self.node()}]"))]
        if chance < 0.5:
            return [f'name = "s{self.draw.randrange(9)}"']
        if chance < 0.55 and deep:
            return [f"if {self.condition()}:", "    return LaunchDescription(nodes)"]
        if chance < 0.65 and self.loops:
            return [f"if {self.condition()}:", f"    {self.draw.choice(('break', 'continue'))}"]
        if chance < 0.8:
            other = ["else:", *self.inside(deep)] if self.draw.random() < 0.5 else []
            return [f"if {self.condition()}:", *self.inside(deep), *other]
        self.loops += 1
        lines = [self.draw.choice(("for one in names:", "for name in ['x', 'y']:")), *self.inside(deep)]
        self.loops -= 1
        return [*lines, "else:", *self.inside(deep)] if self.draw.random() < 0.3 else lines


def program(seed: int) -> str:
    """Return the launch file of a seed."""
    maker = Maker(seed)
    body = [*maker.block(0), *maker.block(0), f"nodes.append({maker.node()})", "return LaunchDescription(nodes)"]
    return HEAD + "".join(f"    {line}\n" for line in body)
