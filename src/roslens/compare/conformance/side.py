"""One side of a comparison: its claims, what it cannot know, and how certain its omissions are."""

from __future__ import annotations

from enum import Enum

import msgspec

from roslens.compare.conformance.claim import NODE, PARAMETER, TOPIC, Claim
from roslens.judge.reference.expectation import Reference
from roslens.model.graph import Graph, Role

ENDPOINTS = tuple(role.value for role in Role)
EVERYTHING = frozenset({NODE, PARAMETER, TOPIC, *ENDPOINTS})


class SideKind(str, Enum):
    """Where a side comes from.

    - source: launch files and code, read
    - running: a system that was observed, or a graph that was written of one
    - recording: a bag
    - reference: what is expected
    """

    SOURCE = "source"
    RUNNING = "running"
    RECORDING = "recording"
    REFERENCE = "reference"


class Origin(str, Enum):
    """What else of a workspace knows something that the configuration compared does not have."""

    OTHER_LAUNCH = "other launch"
    NOT_LAUNCHED = "not launched"
    UNSTARTED = "unstarted"


class Beside(msgspec.Struct, frozen=True):
    """What source has besides the configuration that is compared; it only explains."""

    origin: Origin
    title: str
    claims: tuple[Claim, ...]


class Side(msgspec.Struct, frozen=True):
    """What is compared.

    Attributes:
        kind: where it comes from.
        title: how it is called.
        claims: its claims, each key once.
        knows: the kinds of claims that it can make at all.
        whole: whether what it does not say of these kinds is not there; of a recording it may not have been recorded.
        generation: ``ros1`` or ``ros2``; empty where unknown.
        silent: nodes that do not report their parameters.
        open: why source may start more than it contains, in words; empty if it is complete.
        unread: nodes of which code was not understood, each with the first reason.
        beside: what else the workspace has.
        graph: the same as a graph, for what a reference asks.
        reference: of a reference, what it expects.
    """

    kind: SideKind
    title: str
    claims: tuple[Claim, ...] = ()
    knows: frozenset[str] = EVERYTHING
    whole: bool = True
    generation: str = ""
    silent: frozenset[str] = frozenset()
    open: str = ""
    unread: dict[str, str] = {}
    beside: tuple[Beside, ...] = ()
    graph: Graph | None = None
    reference: Reference | None = None

    def tells(self, claim_kind: str, node: str) -> bool:
        """Return whether it would have a claim of this kind about this node if it were true."""
        if claim_kind == PARAMETER and node in self.silent:
            return False
        return claim_kind in self.knows
