"""Reactions in ``roslens reference check``: what there are, and what of them a recording or a graph does not have."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.model.acting.reaction import Reaction
    from roslens.model.graph import Graph


def reactions_table(reactions: Sequence[Reaction]) -> str:
    """Return a line for each reaction: what it does, in which order, and where it stands; nothing of none."""
    if not reactions:
        return ""
    rows = [("reaction", "does", "stands in")]
    rows += [(one.name, " → ".join(step.action.kind for step in one.steps), one.place) for one in reactions]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows]
    return "\n".join([*lines, f"{len(reactions)} reaction{'' if len(reactions) == 1 else 's'}"])


def types_not_checked(reactions: Sequence[Reaction]) -> list[str]:
    """Return a line for each type that actions name and that is not installed here.

    Raises:
        DocumentError: a package that is known here has no such type, or a type no such field.
    """
    import os

    from roslens.live.react.definitions import folders_of, unchecked_types

    return [
        f"{one.place}: not checked: no definition of {one.type} is here. `roslens react` asks ROS before it begins"
        for one in unchecked_types(reactions, folders_of(os.environ))
    ]


def given_graph(text: str) -> Graph:
    """Return the graph of a run, as ``3:drive.launch.xml``, or of a file.

    Raises:
        DocumentError: the file is none.
        UsageError: there is no such run.
    """
    from roslens.cli.graph.run_graph import graph_of_run, names_run
    from roslens.live.observe.read_rosgraph import read_rosgraph

    return graph_of_run(text).graph if names_run(text) else read_rosgraph(Path(text))
