"""What an evaluation makes: its node, further ones, and objects that act in them."""

from __future__ import annotations

from collections.abc import Sequence

from roslens.source.extract.domain.abstract_value import NodeBuilder, Obj
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.text import Condition, Text

_NO_NAME = Text()


class Emitter:
    """The nodes of one evaluation.

    Attributes:
        node: that is built; overlays add to it.
        first: the node that is built first, whichever is evaluated.
        others: further nodes that were made on the way.
        made: objects of classes of the workspace that are nodes, in the order in which they were made.
        plugged: objects of plug-ins and the nodes they are loaded into.
    """

    __slots__ = ("first", "made", "node", "others", "plugged")

    def __init__(self, node: NodeBuilder) -> None:
        """Build a node."""
        self.node = self.first = node
        self.others: list[NodeBuilder] = []
        self.made: list[Obj] = []
        self.plugged: list[tuple[Obj, NodeBuilder]] = []

    @property
    def nodes(self) -> tuple[NodeBuilder, ...]:
        """All that are made."""
        return (self.first, *self.others)

    def further(
        self, evidence: Evidence, conditions: Sequence[Condition], name: Text = _NO_NAME, arguments: Sequence[Text] = ()
    ) -> NodeBuilder:
        """Return a further node of ROS 2 that is made under conditions."""
        node = NodeBuilder(self.node.unit, evidence.path or self.node.path, evidence.line, "ros2", name=name)
        node.arguments, node.conditions = list(arguments), tuple(dict.fromkeys(conditions))
        self.others.append(node)
        node.number, node.named = len(self.others), True
        return node
