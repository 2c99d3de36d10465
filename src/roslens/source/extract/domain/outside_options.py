"""The options of a node that whoever loads it gives it: as code sees them, nothing is known of them."""

from __future__ import annotations

from roslens.source.extract.domain.abstract_value import Obj
from roslens.source.extract.facts.node_facts import Inherits
from roslens.source.extract.symbolic.text import Hole, Text

OPTIONS = "rclcpp.NodeOptions"
OUTSIDE = Text((Hole("arguments that the node is loaded with"),))
"""Stands for the arguments that whoever loads a component gives it.

What options hold is kept under keys that are no names: methods have the names of members of theirs.
"""


def options_from_outside() -> Obj:
    """Return the options that whoever loads a component gives it."""
    return Obj(OPTIONS, None, {"-arguments": [OUTSIDE], "-inherits": Inherits.ALL})
