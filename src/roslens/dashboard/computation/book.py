"""The configurations of a report and where the pages of their nodes and topics are."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.noise import IMPLICIT
from roslens.dashboard.computation.picture import ComputationGraph, Left, computation_graph
from roslens.dashboard.computation.system import Element, Kind, System
from roslens.dashboard.tables.table import Cell
from roslens.model.configuration import Configuration, Proof


def _no_page(path: str) -> bool:  # noqa: ARG001 - the shape of every lookup
    return False


class Book:
    """Systems by slug, in the order in which they are shown."""

    def __init__(
        self,
        systems: Mapping[str, System],
        has_page: Callable[[str], bool] = _no_page,
        note: str = "",
        *,
        counted: bool = True,
        packages: Collection[str] = (),
        rules: Collection[str] = (),
        unstarted: Sequence[Configuration] = (),
    ) -> None:
        """Take the systems.

        Args:
            systems: by slug.
            has_page: whether the report has a page for a file, by its path below the workspace root.
            note: what readers of every page have to know.
            counted: whether the findings about them are those of the run that the report is about.
            packages: ids of those that the report has a page for.
            rules: ids of those that the report has a page for.
            unstarted: what no known program starts.
        """
        self.unstarted = tuple(unstarted)
        self.note = note
        self.counted = counted
        self.packages = frozenset(packages)
        self.rules = frozenset(rules)
        self.systems = dict(systems)
        self.has_page = has_page
        self._graphs: dict[tuple[str, Left], ComputationGraph] = {}

    def refs(self) -> Iterator[PageRef]:
        """Yield every page, each once: graphs, then nodes, then topics, services and actions."""
        for slug in self.systems:
            yield PageRef("computation", slug)
        for page in ("node", "topic"):
            for system in self.systems.values():
                for element in system.elements:
                    ref = ref_of(system, element)
                    if ref and ref.page == page:
                        yield ref

    def graph(self, system: System, left: Left) -> ComputationGraph:
        """Return the graph of a system; the last few are kept."""
        key = (system.slug, left)
        if key not in self._graphs:
            if len(self._graphs) > 2 * len(self.systems) + 2:
                self._graphs.pop(next(iter(self._graphs)))
            self._graphs[key] = computation_graph(system, left)
        return self._graphs[key]

    def find(self, page: str, key: str) -> tuple[System, int] | None:
        """Return the system and the number of the element that a page is about; None where there is none."""
        slug, _, rest = key.partition("/")
        system = self.systems.get(slug)
        number = system.by_key.get(f"node/{rest}" if page == "node" else rest) if system else None
        ref = ref_of(system, system.elements[number]) if system and number is not None else None
        if system is None or number is None or ref is None or ref.page != page:
            return None
        return system, number

    def package(self, name: str) -> PageRef | None:
        """Return the page of a package; None where the report has none."""
        return PageRef("package", name) if name in self.packages else None

    def rule(self, name: str) -> PageRef | None:
        """Return the page of a rule; None where the report has none."""
        return PageRef("rule", name) if name in self.rules else None

    def place(self, proof: Proof | None) -> Cell:
        """Return where a fact is shown, as a link to the line where the report has its file."""
        if proof is None or not proof.place:
            return Cell("")
        return Cell(proof.place, ref=self.file(proof), hint=proof.how)

    def file(self, proof: Proof) -> PageRef | None:
        """Return the page of the proof's file at its line; None where the report has none."""
        if not self.has_page(proof.path):
            return None
        return PageRef("file", proof.path, anchor=f"L{proof.line}" if proof.line else "")


def ref_of(system: System, element: Element) -> PageRef | None:
    """Return the page of an element; None for a topic or service of which only what every node has is known."""
    if IMPLICIT in element.noise:
        return None
    if element.kind is Kind.NODE:
        return PageRef("node", f"{system.slug}/{element.key.removeprefix('node/')}")
    return PageRef("topic", f"{system.slug}/{element.key}")
