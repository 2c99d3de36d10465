"""``roslens compare A B [C]`` of sides: what is expected against what is there."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import TYPE_CHECKING

from roslens.cli.conformance.side_word import WordKind, kind_of
from roslens.cli.page.named_apart import named_apart
from roslens.cli.terminal.boundary import CLEAN, FINDINGS
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.compare.conformance.disparity import Conformance
    from roslens.compare.conformance.side import Side

_OF_SOURCE = (WordKind.WORKSPACE, WordKind.LAUNCH, WordKind.STORED, WordKind.DOCUMENT, WordKind.RUN)
_FILES = (WordKind.RECORDING, WordKind.WRITTEN, WordKind.REFERENCE)
NEWEST = ("now", "last")


def names_sides(words: Sequence[str], launch: str | None = None) -> bool:
    """Return whether words name sides to compare rather than two runs and the folder of their workspace.

    Raises:
        UsageError: a word is a file that is nothing to compare.
    """
    kinds = [kind_of(word) for word in words]
    return any(kind is not WordKind.RUN for kind in kinds[:2]) or launch is not None


def compare_sides(words: Sequence[str], options: argparse.Namespace) -> int:
    """Compare, write what differs, and return 1 if a difference has at least the severity of ``--fail-on``.

    Raises:
        RoslensError: a side cannot be read, or there is nothing to compare.
    """
    from roslens.cli.terminal.streams import write_result
    from roslens.model.finding import Severity

    found = compared(words, options)
    write_result(_written(found, options), options.output)
    if options.fail_on == "never":
        return CLEAN
    return FINDINGS if found.at_least(Severity(options.fail_on or "warning")) else CLEAN


def compared(words: Sequence[str], options: argparse.Namespace) -> Conformance:
    """Return the comparison of the sides that words name.

    Raises:
        RoslensError: see :func:`compare_sides`.
    """
    from roslens.compare.conformance.join import conformance

    kinds = [kind_of(word) for word in words]
    _require(words, kinds, options)
    files = [word for word, kind in zip(words, kinds, strict=True) if kind in _FILES]
    names = dict(zip(files, named_apart(files), strict=True))
    sides: list[Side | None] = [
        None if kind in _OF_SOURCE else _observed(word, kind, options, names.get(word, word))
        for word, kind in zip(words, kinds, strict=True)
    ]
    known = [one for one in sides if one is not None]
    made = [
        side if side is not None else _of_source(word, kind, options, known)
        for word, kind, side in zip(words, kinds, sides, strict=True)
    ]
    return conformance(made)


def _require(words: Sequence[str], kinds: Sequence[WordKind], options: argparse.Namespace) -> None:
    for word, kind in zip(words, kinds, strict=True):
        if kind is WordKind.RUN and word not in NEWEST and not word.isdecimal():
            raise UsageError(
                f'"{word}" is nothing that can be compared with {" and ".join(one for one in words if one != word)}',
                expected="a workspace, a launch file, a run, `live`, HOST:PORT, a recording or a reference",
            )
    if kinds.count(WordKind.LIVE) > 1:
        raise UsageError('"live" twice', expected="it once")
    if options.launch and WordKind.WORKSPACE not in kinds:
        raise UsageError("--launch without a workspace", expected="its folder, as in `roslens compare . live`")


def _observed(word: str, kind: WordKind, options: argparse.Namespace, name: str) -> Side:
    from roslens.cli.conformance import observed_side

    if kind is WordKind.LIVE:
        return observed_side.live_side(options)
    if kind is WordKind.ADDRESS:
        return observed_side.monitor_side(word)
    if kind is WordKind.RECORDING:
        return observed_side.bag_side(word, name)
    if kind is WordKind.WRITTEN:
        return observed_side.written_side(word, name)
    return observed_side.reference_side(word, name)


def _of_source(word: str, kind: WordKind, options: argparse.Namespace, others: Sequence[Side]) -> Side:
    from roslens.cli.conformance import source_side

    if kind is WordKind.WORKSPACE:
        return source_side.workspace_side(word, options.launch or "", options, others)
    if kind is WordKind.LAUNCH:
        return source_side.workspace_side(options.workspace, word, options, others)
    if kind is WordKind.DOCUMENT:
        return source_side.document_side(word, options, others)
    return source_side.stored_side(word, options, others)


def _written(found: Conformance, options: argparse.Namespace) -> str:
    if options.format == "json":
        from roslens.report.graph.conformance_document import to_conformance_json

        return to_conformance_json(found)
    from roslens.report.graph.conformance_text import to_lines, to_markdown

    return to_markdown(found) if options.format == "markdown" else to_lines(found, notes=options.notes)
