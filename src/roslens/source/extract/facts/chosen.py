"""Which plug-ins a node loads, as far as parameters that are set for it decide: what its code is evaluated with again.

A program that loads classes by the names in its parameters (pluginlib, class_loader) makes what these classes make. Its
code alone does not say which they are: what launch files set does, or the defaults of its code.
"""

from __future__ import annotations

from typing import Protocol

import msgspec

from roslens.source.extract.symbolic.text import Text


class Node(Protocol):
    """A node of an evaluation, while it is built or afterwards."""

    @property
    def path(self) -> str:
        """The file that makes it."""

    @property
    def line(self) -> int:
        """Where it is made."""

    @property
    def name(self) -> Text:
        """As code writes it."""

    @property
    def number(self) -> int:
        """Counts the nodes that one evaluation makes, from 0."""


class Chosen(msgspec.Struct, frozen=True, array_like=True):
    """Parameters that decide which plug-ins are loaded.

    Attributes:
        values: key of a node, name of its parameter, and what it is set to; None where it has its default.
    """

    values: tuple[tuple[str, str, str | None], ...] = ()

    def has(self, node: Node, name: str) -> bool:
        """Return whether a parameter of a node is one of them."""
        key = node_key(node)
        return any(one[:2] == (key, name) for one in self.values)

    def value(self, node: Node, name: str) -> str | None:
        """Return what a parameter is set to; None where it is not."""
        key = node_key(node)
        return next((one[2] for one in self.values if one[:2] == (key, name)), None)


def node_key(node: Node) -> str:
    """Return what tells the nodes apart that one evaluation makes; the first one has none."""
    return f"{node.path}:{node.line}:{node.name.pattern}" if node.number else ""
