"""How much of a computation graph is known, and why the rest is not."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence, Set
from enum import Enum

import msgspec

from roslens.model.configuration import Configuration, ConfiguredNode, Missing, Origin, Unresolved
from roslens.model.failure import Failure
from roslens.model.words.plural import plural

NO_ENDPOINT = "no endpoint was found in its code"
PARTS = "parts of its code could not be evaluated"
"""Reasons why a node is known in part."""
_NAMED = 3


class Known(str, Enum):
    """How much is known of a node.

    - whole: its code, or the catalogue, says everything that it has
    - part: its code was read, and not all of it was understood, or no endpoint was found
    - named: that it is started, and what the launch file says of it
    """

    WHOLE = "whole"
    PART = "part"
    NAMED = "named"


class Gap(msgspec.Struct, frozen=True, omit_defaults=True):
    """A reason why nodes are not whole.

    Attributes:
        reason: in words.
        nodes: how many nodes have it.
        packages: that would tell and are not in the workspace, sorted.
    """

    reason: str
    nodes: int
    packages: tuple[str, ...] = ()


class Completeness(msgspec.Struct, frozen=True, omit_defaults=True):
    """How much of a graph is known.

    Attributes:
        whole: nodes of which all is known.
        part: nodes whose code was read and not understood in full.
        named: nodes of which only the launch file tells.
        missing: places that may start further nodes, which could not be followed.
        unread: further places in own code and launch files that could not be evaluated, and belong to no node.
        gaps: reasons, those of most nodes first.
    """

    whole: int = 0
    part: int = 0
    named: int = 0
    missing: int = 0
    unread: int = 0
    gaps: tuple[Gap, ...] = ()

    @property
    def nodes(self) -> int:
        """How many nodes the graph has."""
        return self.whole + self.part + self.named

    @property
    def is_whole(self) -> bool:
        """Whether nothing of the graph is unknown."""
        return self.nodes > 0 and self.whole == self.nodes and not self.missing and not self.unread

    @property
    def is_unread(self) -> bool:
        """Whether no code of any node was read, so that nothing can be said of what is between them."""
        return not self.whole and not self.part

    @property
    def packages(self) -> tuple[str, ...]:
        """The packages that are not in the workspace and would tell more, those of most nodes first."""
        return tuple(dict.fromkeys(package for gap in self.gaps for package in gap.packages))

    def said(self) -> str:
        """Return it in words: ``2 of 97 nodes complete, 90 by name only (…)``."""
        if not self.nodes and not self.missing and not self.unread:
            return "no nodes"
        parts = [f"{self.whole:,} of {plural(self.nodes, 'node')} complete"]
        if self.part:
            parts.append(f"{self.part:,} in part")
        if self.named:
            parts.append(f"{self.named:,} known by name only")
        if self.missing:
            parts.append(f"{plural(self.missing, 'place')} may start more")
        if self.unread:
            parts.append(f"{plural(self.unread, 'more place')} could not be evaluated")
        return ", ".join(parts)

    def why(self) -> Iterator[str]:
        """Yield a line for each of the main reasons, and what to fetch."""
        for gap in self.gaps[:_NAMED]:
            yield f"{plural(gap.nodes, 'node')}: {gap.reason}"
        if len(self.gaps) > _NAMED:
            others = sum(gap.nodes for gap in self.gaps[_NAMED:])
            yield f"{plural(others, 'node')}: other reasons, see what is unresolved"
        if packages := self.packages[:_NAMED]:
            words = " ".join(f"--package {package}" for package in packages)
            yield f"roslens fetch --distro DISTRO {words} --into FOLDER below the workspace brings what is not here"


def completeness_of(configuration: Configuration) -> Completeness:
    """Return how much of a graph is known."""
    of_node: dict[str, list[Unresolved]] = defaultdict(list)
    of_place: dict[tuple[str, int, int], list[Unresolved]] = defaultdict(list)
    for one in configuration.unresolved:
        if one.node:
            of_node[one.node].append(one)
        else:
            of_place[one.proof.path, one.proof.line, one.proof.column].append(one)
    counts = dict.fromkeys(Known, 0)
    starts = {(one.proof.path, one.proof.line, one.proof.column) for one in configuration.nodes}
    reasons: dict[tuple[str, tuple[str, ...]], int] = defaultdict(int)
    for node in configuration.nodes:
        if node.kind == "process":
            continue
        place = (node.proof.path, node.proof.line, node.proof.column)
        known, reason, packages = _known(node, of_node.get(node.name, ()), of_place.get(place, ()))
        counts[known] += 1
        if reason:
            reasons[reason, packages] += 1
    return Completeness(
        counts[Known.WHOLE],
        counts[Known.PART],
        counts[Known.NAMED],
        sum(one.opens for one in configuration.unresolved),
        sum(_is_apart(one, starts) for one in configuration.unresolved),
        _gaps(reasons),
    )


def _is_apart(one: Unresolved, starts: Set[tuple[str, int, int]]) -> bool:
    """Whether something is unresolved that no node has, and that is not others' code or named like something else."""
    if one.opens or one.node or one.role or one.missing is Missing.NAMED_ALIKE:
        return False
    return (one.proof.path, one.proof.line, one.proof.column) not in starts


def _known(
    node: ConfiguredNode, missed: Sequence[Unresolved], at_start: Sequence[Unresolved]
) -> tuple[Known, str, tuple[str, ...]]:
    if node.defined is None and not any(end.proof.origin in (Origin.CATALOGUE, Origin.HINT) for end in node.endpoints):
        about = next((one for one in at_start if one.outside), None) or next(iter(at_start), None)
        if about is None:
            return Known.NAMED, "its code is not known", ()
        return Known.NAMED, _plain(about), about.outside
    if node.defined is not None and node.defined.origin is Origin.CODE and not _makes_anything(node):
        return Known.PART, NO_ENDPOINT, ()
    if missed or at_start or not node.resolved:
        return Known.PART, PARTS, ()
    return Known.WHOLE, "", ()


def _makes_anything(node: ConfiguredNode) -> bool:
    return any(not end.implicit for end in node.endpoints) or bool(node.timers)


def _plain(one: Unresolved) -> str:
    if one.outside:
        return f"{' and '.join(one.outside[:_NAMED])} is not in the workspace"
    return one.reason.removesuffix("; its endpoints are unknown")


def _gaps(reasons: Mapping[tuple[str, tuple[str, ...]], int]) -> tuple[Gap, ...]:
    order = sorted(reasons.items(), key=lambda item: (-item[1], item[0]))
    return tuple(Gap(reason, nodes, packages) for (reason, packages), nodes in order)


INCOMPLETE = "graph completeness"
"""Tool of the failure that says how much of the graphs of a run is unknown; it leaves nothing else out."""


def incomplete(known: Mapping[str, Completeness]) -> Failure | None:
    """Return what is unknown of the graphs of a run, by the name of each; None where all of each is known."""
    least = [(name, one) for name, one in known.items() if one.nodes and not one.is_whole]
    if not least:
        return None
    name, one = min(least, key=lambda item: (item[1].whole / item[1].nodes, -item[1].nodes, item[0]))
    whole, nodes = sum(each.whole for each in known.values()), sum(each.nodes for each in known.values())
    of_all = f"{whole:,} of {plural(nodes, 'node')} of {plural(len(known), 'computation graph')} complete; least of "
    what = f"{of_all if len(known) > 1 else ''}{name}: {one.said()}"
    return Failure(INCOMPLETE, what, "the code of every node that is started", "; ".join(one.why()), partial=True)
