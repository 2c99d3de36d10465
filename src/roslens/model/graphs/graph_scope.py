"""Which computation graphs a run looked at, and which launch files it left out."""

from __future__ import annotations

import msgspec

from roslens.model.graphs.completeness import Completeness
from roslens.model.words.plural import plural


class GraphScope(msgspec.Struct, frozen=True, omit_defaults=True):
    """The configurations of a run.

    Attributes:
        looked_at: their names, in order.
        left_out: paths of the launch files that are started by themselves and were not looked at, sorted.
        completeness: how much of each graph is known, by its name.
    """

    looked_at: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    completeness: dict[str, Completeness] = {}

    @property
    def among(self) -> int:
        """How many launch files there were to choose from, where some were left out; else 0."""
        return len(self.looked_at) + len(self.left_out) if self.left_out else 0

    @property
    def is_mostly_unknown(self) -> bool:
        """Whether less than half of the nodes of its graphs are known whole or in part."""
        read = sum(one.whole + one.part for one in self.completeness.values())
        return 2 * read < sum(one.nodes for one in self.completeness.values())

    def note(self) -> str:
        """Return what was left out and how to look at it, in one line; empty where nothing was."""
        if not self.left_out:
            return ""
        return (
            f"Computation graph: {len(self.looked_at)} of {plural(self.among, 'launch file')}, those that together "
            "start most nodes; --graph all looks at every one, [graph.configurations] in roslens.toml chooses"
        )
