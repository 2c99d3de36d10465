"""What something that is started by name means: the nodes that it becomes, or why they are unknown."""

from __future__ import annotations

import msgspec

from roslens.model.configuration import Origin
from roslens.source.extract.facts.node_facts import NodeFacts
from roslens.source.extract.symbolic.text import Conditions


class Meant(msgspec.Struct, frozen=True):
    """What something that is started means: its nodes, or the reason why they are unknown.

    ``outside`` are packages that would tell and are not in the workspace.
    """

    facts: tuple[NodeFacts, ...] = ()
    reason: str = ""
    origin: Origin = Origin.CODE
    conditions: Conditions = ()
    kind: str = ""
    outside: tuple[str, ...] = ()
