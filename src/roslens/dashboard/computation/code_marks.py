"""What lines of a file are to the graph: where nodes are defined and started, publish, subscribe and serve."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.book import Book, ref_of
from roslens.dashboard.computation.system import System
from roslens.model.configuration import Proof
from roslens.model.graphs.end import VERB


class CodeMark(msgspec.Struct, frozen=True):
    """A line does something (``does``: *defines node*, *publishes*) to what is called ``name`` and has a page."""

    does: str
    name: str
    ref: PageRef | None


class CodeMarks:
    """The marks of every file that a book names, looked up by path."""

    def __init__(self, book: Book) -> None:
        """Take the marks of a book; marks that are equal in several configurations are one, of the first of them."""
        self._found: dict[str, dict[int, dict[tuple[str, str], CodeMark]]] = {}
        for system in book.systems.values():
            for proof, mark in _marks(system):
                if proof is not None and proof.path and proof.line:
                    of_line = self._found.setdefault(proof.path, {}).setdefault(proof.line, {})
                    of_line.setdefault((mark.does, mark.name), mark)

    def of(self, path: str) -> dict[int, tuple[CodeMark, ...]]:
        """Return the marks of a file by line."""
        return {line: tuple(marks.values()) for line, marks in self._found.get(path, {}).items()}


def _marks(system: System) -> Iterator[tuple[Proof | None, CodeMark]]:
    for number, node in enumerate(system.nodes):
        ref = ref_of(system, system.elements[number])
        yield node.defined, CodeMark("defines node", node.name, ref)
        yield node.proof, CodeMark("starts node", node.name, ref)
    for end in system.ends:
        one = end.configured
        if not one.implicit:
            channel = system.elements[end.channel]
            yield one.proof, CodeMark(VERB[one.endpoint.role], one.endpoint.name, ref_of(system, channel))
