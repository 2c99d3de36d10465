"""`--graph-out`: the graph of a watch in a file, as a message that other programs know."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from pathlib import Path

    from roslens.model.graph import Graph


def write_graph(graph: Graph, path: Path) -> None:
    """Write a graph as a rosgraph_msgs/msg/Graph, whole or not at all.

    Raises:
        UsageError: the file cannot be written.
    """
    from roslens.report.graph.to_rosgraph import to_rosgraph
    from roslens.report.writing.whole_file import whole_file

    try:
        with whole_file(path) as stream:
            stream.write(to_rosgraph(graph))
    except OSError as error:
        raise UsageError(f"--graph-out {str(path)!r}: {error.strerror or error}", expected="a file to write") from None
