"""What the pages of a run are held against: what runs beside them, and files that were named."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.conformance.side_word import WordKind, kind_of
from roslens.cli.page.named_apart import named_apart
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.compare.conformance.disparity import Conformance
    from roslens.compare.conformance.side import Side
    from roslens.dashboard.site import Site
    from roslens.model.graph import Graph

_FILES = (WordKind.RECORDING, WordKind.REFERENCE, WordKind.WRITTEN)
MOST = 2
"""Sides beside source."""


def add_against_argument(parser: argparse._ActionsContainer) -> None:
    """Add what source is held against."""
    parser.add_argument(
        "--against", action="append", default=[], metavar="SIDE",
        help="hold the graph of the source against a recording, a reference, or a graph that was written, on a page of "
        "its own; with --live against what runs too",
    )  # fmt: skip


def shown_sides(
    words: Sequence[str], live: Callable[[], Graph | None] | None, *, recorded: Sequence[Path] = ()
) -> Callable[[], list[Side]] | None:
    """Return what gives the sides beside source, read anew where they change; None where there is none.

    Args:
        words: what ``--against`` names; a file that is named again, or shown already, is one side.
        live: gives the graph of what is shown beside the run; None where nothing is.
        recorded: the recording of which that is the graph; empty of what runs.

    Raises:
        UsageError: a word is nothing to hold source against, or there are too many.
        DocumentError: a reference or a graph is wrong.
    """
    from roslens.cli.conformance import observed_side

    kinds = [kind_of(word) for word in words]
    for word, kind in zip(words, kinds, strict=True):
        if kind not in _FILES:
            raise UsageError(f'--against "{word}"', expected="a recording, a reference, or a graph that was written")
    words = list(_each_once(words, recorded if len(recorded) == 1 else ()))
    if len(words) + (live is not None) > MOST:
        raise UsageError(f"{len(words)} of --against{' with --live' if live else ''}", expected=f"{MOST} at most")
    if not words and live is None:
        return None
    read = {
        WordKind.RECORDING: observed_side.bag_side,
        WordKind.REFERENCE: observed_side.reference_side,
        WordKind.WRITTEN: observed_side.written_side,
    }
    names = named_apart([*recorded, *words])
    kept = [read[kind_of(word)](word, name) for word, name in zip(words, names[len(recorded) :], strict=True)]
    of_recorded = ", ".join(names[: len(recorded)])

    def sides() -> list[Side]:
        found = [*_live(live, of_recorded), *kept]
        if not found:
            raise UsageError("what runs was not seen yet", expected="a node that runs")
        return found

    return sides


def _each_once(words: Iterable[str], known: Iterable[Path]) -> Iterator[str]:
    """Yield the words that name files which no word before them names, and which are not known."""
    seen = {one.resolve() for one in known}
    for word in words:
        path = Path(word).resolve()
        if path not in seen:
            seen.add(path)
            yield word


def _live(live: Callable[[], Graph | None] | None, recorded: str) -> list[Side]:
    from roslens.compare.conformance.observed import recorded_side, running_side

    graph = live() if live is not None else None
    if graph is None or not (graph.nodes or graph.endpoints):
        return []
    return [recorded_side(graph, recorded) if recorded else running_side(graph, "what runs")]


def against(site: Site, sides: Callable[[], list[Side]]) -> Callable[[str], tuple[str, Conformance, list[Side]]]:
    """Return what compares a configuration of a site, by its slug, with these sides; without one that fits best."""
    from roslens.cli.conformance.source_side import beside, best
    from roslens.compare.conformance.configured import source_side
    from roslens.compare.conformance.join import conformance

    def compare(slug: str) -> tuple[str, Conformance, list[Side]]:
        others = sides()
        kept = {name: system.configuration for name, system in site.book.systems.items()}
        name = slug or best(kept, others, argparse.Namespace(quiet=True))
        rest = {other: one for other, one in kept.items() if other != name}
        source = source_side(kept[name], name, beside(kept[name], rest, (), site.book.unstarted))
        return name, conformance([source, *others]), others

    return compare
