"""Which findings are new, gone or only in another file, by their fingerprints and messages."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.graphs.end import KIND

_PLACE = re.compile(r"[^\s()\[\]\"'`,;]+:\d+(?::\d+)?")


class MovedFinding(msgspec.Struct, frozen=True):
    """A finding that both sides have, each in another file: its messages differ in places only."""

    before: Finding
    after: Finding


class FindingDifference(msgspec.Struct, frozen=True):
    """Findings of one of two sides only; what both have is in neither.

    Attributes:
        new: as the later side has them, with its places.
        gone: as the earlier side had them, with its places.
        moved: those that only went to another file; they make no difference.
    """

    new: tuple[Finding, ...] = ()
    gone: tuple[Finding, ...] = ()
    moved: tuple[MovedFinding, ...] = ()

    def __bool__(self) -> bool:
        """Return whether any is new or gone."""
        return bool(self.new or self.gone)


def finding_difference(
    before: Sequence[Finding], after: Sequence[Finding], renamed: Mapping[str, str] | None = None
) -> FindingDifference:
    """Return what only one side has, in its order; lines that moved and words that changed are no difference.

    Args:
        before: findings of the earlier side.
        after: findings of the later side.
        renamed: files that have another path on the later side, by the earlier one.
    """
    old, new = ({one.fingerprint: one for one in reversed(side)} for side in (before, after))
    came, gone = _without(after, new, old), _without(before, old, new)
    waiting: dict[tuple[str, str, str], list[Finding]] = {}
    for one in gone:
        waiting.setdefault(_said(one, renamed or {}), []).append(one)
    moved = []
    for one in came:
        alike = waiting.get(_said(one, {}), [])
        place = next((place for place, other in enumerate(alike) if other.path != one.path), None)
        if place is not None:
            moved.append(MovedFinding(alike.pop(place), one))
    there = {id(one) for pair in moved for one in (pair.before, pair.after)}
    came, gone = (tuple(one for one in side if id(one) not in there) for side in (came, gone))
    return FindingDifference(came, gone, tuple(moved))


def _said(finding: Finding, renamed: Mapping[str, str]) -> tuple[str, str, str]:
    """Return what a finding is about and says, without places in files, names of files as the later side has them."""
    message = _PLACE.sub("", finding.message)
    for before, after in renamed.items():
        if before in message:
            message = message.replace(before, after)
    kind, _, rest = finding.entity.partition(":")
    path, mark, inside = rest.partition("#")
    entity = f"{kind}:{renamed[path]}{mark}{inside}" if path in renamed else finding.entity
    return finding.rule, entity, message


def _without(findings: Sequence[Finding], own: dict[str, Finding], other: dict[str, Finding]) -> tuple[Finding, ...]:
    # Of several with one fingerprint the first speaks for all.
    return tuple(one for one in findings if one is own[one.fingerprint] and one.fingerprint not in other)


def about(findings: Sequence[Finding], configuration: Configuration) -> tuple[Finding, ...]:
    """Return the findings about nodes of a configuration: themselves, their parameters and what they are joined to."""
    nodes = {node.name for node in configuration.nodes}
    entities = {f"node:{name}" for name in nodes} | {
        f"{KIND[one.endpoint.role]}:{one.endpoint.name}" for node in configuration.nodes for one in node.endpoints
    }
    return tuple(one for one in findings if one.entity in entities or _node_of_parameter(one.entity) in nodes)


def _node_of_parameter(entity: str) -> str:
    kind, _, rest = entity.partition(":")
    return rest.partition(":")[0] if kind == "parameter" else ""
