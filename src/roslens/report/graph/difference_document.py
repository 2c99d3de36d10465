"""Differences of computation graphs as JSON."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.compare.finding_difference import FindingDifference
from roslens.compare.graph_difference import Difference

SCHEMA = "roslens-graph-difference/1"


class DifferenceDocument(msgspec.Struct, frozen=True):
    """What ``roslens graph --diff A B --format json`` writes; within version 1 keys are only added.

    Attributes:
        schema: and its version.
        before: how A is called.
        after: how B is called.
        differences: of nodes, endpoints, parameters and remappings.
        findings: that are new and gone; null where nobody looked for any.
    """

    schema: str
    before: str
    after: str
    differences: tuple[Difference, ...]
    findings: FindingDifference | None


def to_difference_json(
    found: Sequence[Difference], before: str, after: str, findings: FindingDifference | None = None
) -> str:
    """Return differences as a JSON document."""
    encoded = msgspec.json.encode(DifferenceDocument(SCHEMA, before, after, tuple(found), findings))
    return msgspec.json.format(encoded, indent=1).decode() + "\n"
