"""Which findings are new and which are gone, by their fingerprints."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.graph import Role

_KINDS = {
    Role.PUBLISHER: "topic",
    Role.SUBSCRIPTION: "topic",
    Role.SERVICE_SERVER: "service",
    Role.SERVICE_CLIENT: "service",
    Role.ACTION_SERVER: "action",
    Role.ACTION_CLIENT: "action",
}


class FindingDifference(msgspec.Struct, frozen=True):
    """Findings of one of two sides only; what both have is in neither.

    Attributes:
        new: as the later side has them, with its places.
        gone: as the earlier side had them, with its places.
    """

    new: tuple[Finding, ...] = ()
    gone: tuple[Finding, ...] = ()

    def __bool__(self) -> bool:
        """Return whether there is any."""
        return bool(self.new or self.gone)


def finding_difference(before: Sequence[Finding], after: Sequence[Finding]) -> FindingDifference:
    """Return what only one side has, in its order; lines that moved and words that changed are no difference."""
    old, new = ({one.fingerprint: one for one in reversed(side)} for side in (before, after))
    return FindingDifference(_without(after, new, old), _without(before, old, new))


def _without(findings: Sequence[Finding], own: dict[str, Finding], other: dict[str, Finding]) -> tuple[Finding, ...]:
    # Of several with one fingerprint the first speaks for all.
    return tuple(one for one in findings if one is own[one.fingerprint] and one.fingerprint not in other)


def about(findings: Sequence[Finding], configuration: Configuration) -> tuple[Finding, ...]:
    """Return the findings about nodes of a configuration: themselves, their parameters and what they are joined to."""
    nodes = {node.name for node in configuration.nodes}
    entities = {f"node:{name}" for name in nodes} | {
        f"{_KINDS[one.endpoint.role]}:{one.endpoint.name}" for node in configuration.nodes for one in node.endpoints
    }
    return tuple(one for one in findings if one.entity in entities or _node_of_parameter(one.entity) in nodes)


def _node_of_parameter(entity: str) -> str:
    kind, _, rest = entity.partition(":")
    return rest.partition(":")[0] if kind == "parameter" else ""
