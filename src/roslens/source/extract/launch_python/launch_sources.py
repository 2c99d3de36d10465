"""The programs of a launch file in Python: its own, and those of modules of the workspace that it imports.

A launch file sees modules by ``sys.path``, and those of packages.
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from functools import lru_cache

from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.ir.program import Expression, Program
from roslens.source.extract.lowering.python.located_program import Places, located_program
from roslens.source.extract.symbolic.text import Condition, Written
from roslens.source.extract.symbols.memo import Memo

MOST_MODULES = 20
MOST_KEPT = 64
"""Files whose programs are known: many launch files include the same ones, each of which is evaluated anew."""
MOST_KEPT_BYTES = 50_000
"""Of each of them."""
_KNOWN = frozenset(
    {"launch", "launch_ros", "launch_xml", "launch_yaml", "launch_param_builder", "launch_testing", "nav2_common",
     "moveit_configs_utils", "ament_index_python", "rclpy", "xacro", "yaml"}
)  # fmt: skip
"""Modules of which the vocabulary knows what they have."""
_PACKAGE = re.compile(
    rb"(?:get_package_share_(?:directory|path)|FindPackageShare)\(\s*(?:package\s*=\s*)?['\"](\w+)['\"]"
)


def programs_of(path: str, content: bytes, files: Files | None) -> tuple[dict[str, Program], Places]:
    """Return the programs of a launch file and of what it imports, directly or not, and where expressions stand.

    It is taken that nothing is raised: what handles exceptions is no part of them.

    Args:
        path: of the launch file.
        content: of it.
        files: of the workspace; None finds no modules.
    """
    places = Places()
    found = {path: _program(content, places)}
    waiting = [path] if files is not None else []
    while waiting and files is not None:
        one = waiting.pop(0)
        for other in _imported(found[one], one, files):
            inside = files.content(other) if other not in found and len(found) <= MOST_MODULES else None
            if inside is not None:
                found[other] = _program(inside, places)
                waiting.append(other)
    return found, places


def _program(content: bytes, places: Places) -> Program:
    """Return the program of a file; where its expressions stand is added to ``places``."""
    program, found = (_lowered if len(content) <= MOST_KEPT_BYTES else _lowered_now)(content)
    places.take(found)
    return program


def _lowered_now(content: bytes) -> tuple[Program, Places]:
    return located_program(content, handlers=False)


_lowered = lru_cache(MOST_KEPT)(_lowered_now)


def _imported(program: Program, path: str, files: Files) -> Iterator[str]:
    """Yield the files of the modules that a file may mean."""
    folders: dict[str, list[str]] = {}
    for name in dict.fromkeys((*program.imports.values(), *program.using, *(name for name, _ in program.includes))):
        pieces = name.split(".")
        first = pieces[0]
        if not first or first in _KNOWN or first in sys.stdlib_module_names:
            continue
        if first not in folders:
            folders[first] = _folders(first, path, files)
        for place in range(len(pieces), 0, -1):
            for folder in folders[first]:
                yield f"{joined(folder, '/'.join(pieces[:place]))}.py"


def _folders(first: str, path: str, files: Files) -> list[str]:
    content = files.content(path) or b""
    found = []
    if b"sys.path" in content:
        found.append(path.rpartition("/")[0])
        for one in dict.fromkeys(_PACKAGE.findall(content)):
            folder = files.package(one.decode())
            found += [] if folder is None else [joined(folder, "launch"), folder]
    package = files.package(first)
    return found if package is None else [*found, package]


class AsWritten(Memo):
    """What an index said, with expressions as a launch file has them: who reads of a condition looks for it there."""

    def __init__(self, places: Places) -> None:
        """Take where expressions stand."""
        super().__init__()
        self._places = places
        self._shown: dict[int, tuple[Expression, str]] = {}

    def text(self, expression: Expression) -> str:
        """Return an expression as text, with the spaces and quotes of ``ast.unparse``."""
        place = self._places.of(expression)
        if place is None:
            return super().text(expression)
        known = self._shown.get(id(expression))
        if known is None or known[0] is not expression:
            known = self._shown[id(expression)] = (expression, _tidied(place.text))
        return known[1]

    def condition(self, expression: Expression) -> Condition:
        """Return a condition, which is not looked into."""
        if self._places.of(expression) is None:
            return super().condition(expression)
        return Written(self.text(expression))


def _tidied(written: str) -> str:
    try:
        return ast.unparse(ast.parse(f"({written})", mode="eval"))
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return " ".join(written.split())
