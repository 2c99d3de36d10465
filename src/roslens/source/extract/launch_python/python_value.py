"""Values of a Python launch file while it is evaluated: plain ones, substitutions, things made, and what is unknown."""

from __future__ import annotations

import ast
from typing import Any

import msgspec

from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch_python.deferred import Deferred, Value
from roslens.source.extract.launch_python.launch_action import text, unknown_value
from roslens.source.extract.symbolic.text import Text

PARAMETER_FILES = frozenset({"ParameterFile", "RewrittenYaml", "ReplaceString"})
"""Classes that stand for a file of parameters, in which they may rewrite something."""


class Unknown(msgspec.Struct, frozen=True):
    """A value of which nothing is known but why."""

    reason: str


class Dotted(msgspec.Struct, frozen=True):
    """What an import brought, by its whole name: ``launch.actions.GroupAction``, ``os.path``."""

    name: str

    @property
    def last(self) -> str:
        """The name without its module."""
        return self.name.rpartition(".")[2]


class Made(msgspec.Struct, eq=False):
    """An object of a class of the vocabulary, with what it was made from.

    Attributes:
        name: of the class, without module.
        evidence: where it was made.
        positional: arguments by position.
        named: arguments by name.
        notes: conditions around it that could not be evaluated.
    """

    name: str
    evidence: Evidence
    positional: list[Any] = []
    named: dict[str, Any] = {}
    notes: tuple[str, ...] = ()

    def argument(self, place: int, *names: str) -> Any:
        """Return an argument by position or the first of its names; None where it is not given."""
        for name in names:
            if name in self.named:
                return self.named[name]
        return self.positional[place] if 0 <= place < len(self.positional) else None


class Closure(msgspec.Struct, eq=False):
    """A function of the file, with the names around it."""

    node: ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda
    names: list[dict[str, Any]]


class Either(msgspec.Struct, eq=False):
    """One value while ``note`` holds, else the other."""

    note: str
    one: Any
    other: Any


class Bound(msgspec.Struct, eq=False):
    """A method of a value."""

    of: Any
    name: str


def as_value(found: Any) -> Value:
    """Return a value as a text with substitutions; a list is its items one after the other, as launch has it."""
    match found:
        case str() | Text() | Deferred():
            return found
        case bool() | int() | float():
            return str(found)
    if found is None:
        return ""
    match found:
        case list() | tuple():
            return text(*(as_value(one) for one in found)) if found else ""
        case Unknown():
            return unknown_value(found.reason)
        case Either():
            return unknown_value(f"one of two values, by {found.note}")
        case Made():
            if found.name in PARAMETER_FILES:
                return Deferred("rewritten", (as_value(found.argument(0, "param_file", "source_file")),))
            return unknown_value(f"a {found.name}")
    return unknown_value(f"a {type(found).__name__.lower()}")


def shown(found: Any) -> str:
    """Return a value in words."""
    value = as_value(found)
    return value if isinstance(value, str) else str(value) if isinstance(value, Text) else str(value.parts[:1])
