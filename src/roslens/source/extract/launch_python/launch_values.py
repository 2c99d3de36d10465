"""Values of launch files in Python beside those of all programs: what is made of classes of launch, and choices."""

from __future__ import annotations

from typing import Any, TypeAlias

import msgspec

from roslens.source.extract.domain.abstract_value import Class, Foreign, Named, Obj, Unknown, Value
from roslens.source.extract.domain.guarded import Guarded
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch_python.deferred import Deferred
from roslens.source.extract.launch_python.deferred import Value as Written
from roslens.source.extract.launch_python.launch_action import text, unknown_value
from roslens.source.extract.launch_python.launch_weight import Weight
from roslens.source.extract.symbolic.text import Condition, Conditions, Text

PARAMETER_FILES = frozenset({"ParameterFile", "RewrittenYaml", "ReplaceString"})
"""Classes that stand for a file of parameters, in which they may rewrite something."""

Plain: TypeAlias = Any
"""A value as Python has it: a known text is a ``str``, keys of a dictionary are texts, numbers or substitutions."""


class Made(Foreign, frozen=True, eq=False):
    """An object of a class of launch, with what it was made from.

    Attributes:
        name: of the class, without module.
        evidence: where it was made.
        positional: arguments by position; what is added to a description later stands behind them.
        named: arguments by name.
        conditions: around it that are open.
        stands_for: the path that it comes to, where it is a copy of a file.
    """

    name: str
    evidence: Evidence
    positional: list[Value] = msgspec.field(default_factory=list)
    named: dict[str, Value] = msgspec.field(default_factory=dict)
    conditions: Conditions = ()
    stands_for: Deferred | None = None

    def argument(self, place: int, *names: str) -> Value:
        """Return an argument by position or the first of its names; None where it is not given."""
        for name in names:
            if name in self.named:
                return self.named[name]
        return self.positional[place] if 0 <= place < len(self.positional) else None


class Visited(msgspec.Struct, frozen=True, eq=False):
    """What something was made from as Python has it, when it is visited. See :class:`Made` for its attributes."""

    name: str
    evidence: Evidence
    positional: list[Plain]
    named: dict[str, Plain]

    @classmethod
    def of(cls, made: Made) -> Visited:
        """Return what is visited."""
        named = {name: plain(value) for name, value in made.named.items()}
        return cls(made.name, made.evidence, plain(made.positional), named)

    def argument(self, place: int, *names: str) -> Plain:
        """Return an argument by position or the first of its names; None where it is not given."""
        for name in names:
            if name in self.named:
                return self.named[name]
        return self.positional[place] if 0 <= place < len(self.positional) else None


class Opened(Foreign, frozen=True):
    """A file that is read, by its path in the workspace."""

    path: str


class Either(Foreign, frozen=True, eq=False):
    """One value while a condition holds, else the other."""

    condition: Condition
    one: Value
    other: Value


def plain(value: Value, weight: Weight | None = None) -> Plain:
    """Return a value as Python has it, with what is inside; what is made stays, for it is looked into when visited.

    Raises:
        BudgetExceededError: it is too large to follow.
    """
    weight = weight or Weight()
    weight.add(value)
    match value:
        case Text():
            return value if value.known is None else value.known
        case list() | tuple():
            return [_item(one, weight) for one in value]
        case dict():
            return {_key(key): plain(one, weight) for key, one in value.items()}
        case Guarded():
            return plain(value.value, weight)
        case Class():
            return _of_class(value)
        case Obj():
            return Unknown(f"a {value.type}") if value.defined is None else _of_class(Class(value.defined))
    return value


def _item(value: Value, weight: Weight) -> Plain:
    """Return an item of a list; of what is made, whether the list has it is kept."""
    if isinstance(value, Guarded) and isinstance(value.value, Made | Either):
        weight.add(value)
        return value
    return plain(value, weight)


def _key(key: Any) -> Any:
    return key.known if isinstance(key, Text) and key.known is not None else key


def _of_class(value: Class) -> Unknown:
    return Unknown(f"class {value.defined.what.qualified_name} of {value.defined.path}")


def lifted(found: Plain) -> Value:
    """Return a value of Python as the interpreter has it."""
    match found:
        case str():
            return Text.of(found)
        case list() | tuple():
            return [lifted(one) for one in found]
        case dict():
            return {Text.of(key) if isinstance(key, str) else key: lifted(one) for key, one in found.items()}
    value: Value = found
    return value


def as_value(found: Plain) -> Written:
    """Return a value as a text with substitutions; a list is its items one after the other, as launch has it."""
    match found:
        case str() | Deferred():
            return found
        case Text():
            return found if found.known is None else found.known
        case bool() | int() | float():
            return str(found)
        case None:
            return ""
    return _of_others(found)


def _of_others(found: Plain) -> Written:
    match found:
        case list() | tuple():
            return text(*(as_value(one) for one in found)) if found else ""
        case Unknown():
            return unknown_value(str(found.reason))
        case Either():
            return unknown_value(f"one of two values, by {found.condition}")
        case Guarded():
            return as_value(found.value)
        case Opened():
            return Deferred("content", (found.path,))
        case Made():
            return unknown_value(f"a {found.name}") if found.stands_for is None else found.stands_for
        case Named():
            return unknown_value(f"the name {found.name}")
        case Class() | Obj():
            return as_value(plain(found))
    return unknown_value(f"a {type(found).__name__.lower()}")


def shown(found: Plain) -> str:
    """Return a value in words."""
    value = as_value(found)
    return value if isinstance(value, str) else str(value) if isinstance(value, Text) else str(value.parts[:1])
