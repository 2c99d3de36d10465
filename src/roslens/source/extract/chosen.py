"""Which plug-ins a node loads, as far as parameters that are set for it decide: what its code is evaluated with again.

A program that loads classes by the names in its parameters (pluginlib, class_loader) makes what these classes make. Its
code alone does not say which they are: what launch files set does, or the defaults of its code.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

if TYPE_CHECKING:
    from roslens.source.extract.abstract_value import Building
    from roslens.source.extract.node_facts import NodeFacts


class Chosen(msgspec.Struct, frozen=True, array_like=True):
    """Parameters that decide which plug-ins are loaded.

    Attributes:
        values: key of a node, name of its parameter, and what it is set to; None where it has its default.
    """

    values: tuple[tuple[str, str, str | None], ...] = ()

    def has(self, node: Building, name: str) -> bool:
        """Return whether a parameter of a node is one of them."""
        key = node_key(node)
        return any(one[:2] == (key, name) for one in self.values)

    def value(self, node: Building, name: str) -> str | None:
        """Return what a parameter is set to; None where it is not."""
        key = node_key(node)
        return next((one[2] for one in self.values if one[:2] == (key, name)), None)


def node_key(node: Building | NodeFacts) -> str:
    """Return what tells the nodes apart that one evaluation makes; the first one has none."""
    return f"{node.path}:{node.line}:{node.name.pattern}" if node.number else ""
