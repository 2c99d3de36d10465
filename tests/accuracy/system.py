"""The systems that are run and read: what they are made of, how they start, and why source and run differ."""

from __future__ import annotations

import os
from fnmatch import fnmatchcase
from pathlib import Path

import msgspec

from accuracy.facts import Fact

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
CORPORA = "ROSLENS_CORPORA"
"""The folder with clones of public code, where there is one."""
OUTSIDE = frozenset({"run-time only", "not built", "not installed", "not in the source"})
"""Causes that lie outside of what the sources given can tell."""


class Reason(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Why source and run differ.

    Attributes:
        cause: in a word or two; those of ``OUTSIDE`` take a fact out of what can be resolved.
        why: in a sentence.
        of: patterns of facts: ``kind node name``, each with ``*``.
        what: ``missed``, ``extra``, or the value that is another.
    """

    cause: str
    why: str
    of: tuple[str, ...] = ()
    what: str = "missed"

    @property
    def outside(self) -> bool:
        """Whether it takes a fact out of what can be resolved."""
        return self.cause in OUTSIDE

    def holds(self, fact: Fact, what: str) -> bool:
        """Tell whether it is about a difference."""
        text = " ".join(part or "-" for part in (fact.kind, fact.node, fact.name))
        return what in self.what.split() and any(fnmatchcase(text, pattern) for pattern in self.of)


class System(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Nodes that run together.

    Attributes:
        title: in words.
        generation: ``ros1`` or ``ros2``.
        launch: launch file that says what runs, as ``package/file``.
        parts: folders that make the workspace: below the repository, ``source:name`` (what Debian ships as source) or
            ``corpora:name`` (a clone); with ``> folder`` where they go, their own name if none is said.
        arguments: of the launch file.
        commands: the same by hand, as words of command lines (ROS 2); where none are given the launch file is started.
        nodes: how many nodes there are when all have come.
        silent: how many of them tell no parameters, because they wait and nobody spins them (ROS 2).
        requests: calls that are made before it is looked at: life cycle transitions as ``node transition``.
        interfaces: packages of interfaces that have to be built, and packages that they hold.
        needs: programs or files without which it cannot run here.
        quick: whether it is run by ``make test``.
        about: what it shows.
        reasons: why source and run differ.
    """

    title: str
    generation: str
    launch: str
    parts: tuple[str, ...]
    about: str
    nodes: int
    silent: int = 0
    arguments: dict[str, str] = {}
    commands: tuple[str, ...] = ()
    requests: tuple[str, ...] = ()
    interfaces: dict[str, tuple[str, ...]] = {}
    needs: tuple[str, ...] = ()
    quick: bool = False
    reasons: tuple[Reason, ...] = ()
    name: str = ""


def systems() -> dict[str, System]:
    """Return all systems by name, those of ROS 1 first."""
    found = {}
    for path in sorted((HERE / "systems").glob("*.yaml")):
        system = msgspec.yaml.decode(path.read_bytes(), type=System)
        found[path.stem] = msgspec.structs.replace(system, name=path.stem)
    return dict(sorted(found.items(), key=lambda one: (one[1].generation, one[0])))


def folder_of(part: str) -> Path:
    """Return where a part of a workspace lies, whether it is there or not."""
    part = part.partition(" > ")[0]
    where, colon, name = part.partition(":")
    if not colon:
        return ROOT / part
    if where == "source":
        return ROOT / "build" / "ros_source" / name
    return Path(os.environ.get(CORPORA) or "/nonexistent") / name


def missing(system: System) -> str:
    """Return why a system cannot be read here; empty where it can."""
    gone = [part for part in system.parts if not folder_of(part).is_dir()]
    return f"not there: {', '.join(gone)}" if gone else ""
