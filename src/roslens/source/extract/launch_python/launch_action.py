"""Actions of ROS 2 launch files, in one form for XML, YAML and Python."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch_python.deferred import Deferred, Scope, Value
from roslens.source.extract.symbolic.text import Text


class Condition(msgspec.Struct, frozen=True):
    """When an action is visited: while ``value`` is true, or with ``wanted`` False while it is not."""

    value: Value
    wanted: bool = True
    written: str = ""


class FileChange(msgspec.Struct, frozen=True):
    """What is done to a file of parameters before a node reads it.

    Attributes:
        kind: ``substitutes`` (substitutions in it), ``replace`` (texts in it by others), ``names`` (values of
            parameters by their name or path), ``keys`` (keys by others), ``values`` (values by others) or ``root``
            (all is put below a key).
        pairs: what is replaced, and by what.
        value: of ``root``.
        numbers: whether what is put in is made a number where it looks like one.
        condition: of ``replace``.
        wanted: what the condition must be.
    """

    kind: str
    pairs: tuple[tuple[Value, Value], ...] = ()
    value: Value = ""
    numbers: bool = False
    condition: Value = "true"
    wanted: bool = True


class Parameter(msgspec.Struct, frozen=True):
    """Parameters given to a node: one by name, or all of a file where ``file`` is set.

    ``changes`` are made to the file in their order; ``type`` is forced.
    """

    evidence: Evidence
    name: Value = ""
    value: Value = ""
    type: str = ""
    file: Value | None = None
    changes: tuple[FileChange, ...] = ()


class Action(msgspec.Struct, frozen=True):
    """An action.

    Attributes:
        kind: ``argument``, ``set``, ``environment`` (a variable is changed, ``*`` for all), ``include``, ``group``,
            ``namespace``, ``parameter``, ``remap``, ``node``, ``lifecycle``, ``container``, ``component``, ``load``,
            ``process``, ``sequence`` (its children, in the scope around it), ``call`` (children are made when it is
            visited), ``loop`` (its children are visited once a turn), ``nothing`` or ``unknown``.
        evidence: where it is written.
        values: by name, as given: ``name``, ``default``, ``package``, ``executable``, ``namespace``, ``plugin`` …; of a
            ``loop`` what it is ``over``: sets of values, or a number where it has the ``name`` of the index.
        children: of groups and sequences; components of a container; arguments of an include as ``set``.
        condition: of it.
        parameters: of nodes and ``parameter``.
        remaps: of nodes and ``remap``: from and to.
        scoped: whether what a group sets is undone after it.
        note: of ``unknown`` and ``sequence``: the reason, or the event that starts it.
        make: of ``call``: makes the children.
    """

    kind: str
    evidence: Evidence
    values: dict[str, Value] = {}
    children: tuple[Action, ...] = ()
    condition: Condition | None = None
    parameters: tuple[Parameter, ...] = ()
    remaps: tuple[tuple[Value, Value], ...] = ()
    scoped: bool = True
    note: str = ""
    words: tuple[Value, ...] = ()
    make: Callable[[Scope], tuple[Action, ...]] | None = None


def text(*parts: Value) -> Value:
    """Return values one after the other as one."""
    if len(parts) == 1:
        return parts[0]
    if all(isinstance(part, str) for part in parts):
        return "".join(str(part) for part in parts)
    return Deferred("text", parts)


def unknown_value(reason: str) -> Deferred:
    """Return a value that is unknown for a reason."""
    return Deferred("unknown", (reason,))


__all__ = ["Action", "Condition", "FileChange", "Parameter", "Text", "text", "unknown_value"]
