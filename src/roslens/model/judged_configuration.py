"""A configuration under the name that users know it by, and what is wrong with it."""

from __future__ import annotations

import msgspec

from roslens.model.configuration import Configuration
from roslens.model.finding import Finding


class JudgedConfiguration(msgspec.Struct, frozen=True):
    """What a run keeps of a computation graph.

    Attributes:
        name: under which it is shown and asked for.
        configuration: what would run.
        findings: of the rules of the graph, sorted by place.
    """

    name: str
    configuration: Configuration
    findings: tuple[Finding, ...] = ()
