"""From what native rules found to findings: those that are on, with their file, function and fingerprint."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import PurePosixPath

from roslens.model.entity import Entity, EntityKind
from roslens.model.finding import Finding, fingerprint
from roslens.model.weight.consequence import severity_of
from roslens.source.rules.hit import EITHER, GUARDED, HEADER, SOURCE, Hit
from roslens.source.rules.rule import TOOL, Rule
from roslens.source.rules.selection import Selection

HEADER_ENDINGS = frozenset({".h", ".hh", ".hpp", ".hxx", ".h++", ".cuh", ".ipp", ".tpp", ".inl"})
"""Endings of files that others include."""

PIECE_ENDINGS = frozenset({".ipp", ".tpp", ".inl"})
"""Those of them that a header includes at its end, and that need no guard."""

_PIECE_STEMS = ("-inl", "_inl", "-impl", "_impl", ".impl", ".inl")

FORM_ENDING = ".ui.h"
"""The end of a file of code of Qt Designer, which is included once by what is generated."""


def place_hits(
    hits: Mapping[str, Iterable[Hit]],
    callbacks: Iterable[str],
    selection: Selection,
    rules: Mapping[str, Rule],
    entities: Sequence[Entity],
) -> tuple[Finding, ...]:
    """Return findings in order of their paths, then as they were found.

    Args:
        hits: by the path of the file, or of what a rule on packages names.
        callbacks: names of the functions that any file of the package registers.
        selection: the rules that are on.
        rules: all of them.
        entities: of the package, measured.
    """
    known = frozenset(callbacks)
    around = _Around(entities)
    seen: Counter[tuple[str, str, str]] = Counter()
    found: list[Finding] = []
    for path in sorted(hits):
        counted, is_c = _counted(PurePosixPath(path)), path.endswith(".c")
        for hit in hits[path]:
            if hit.rule not in selection or not _counts(hit, rules[hit.rule], counted, known, is_c=is_c):
                continue
            entity = hit.entity or around.innermost(path, hit.line) or f"file:{path}"
            key = (hit.rule, entity, hit.context)
            found.append(_finding(hit, path, entity, seen[key], selection, rules[hit.rule]))
            seen[key] += 1
    return tuple(found)


def _counts(hit: Hit, rule: Rule, counted: Collection[str], callbacks: Collection[str], *, is_c: bool) -> bool:
    """Whether a hit is one in a file of this kind, and in a function that is a callback where it has to be."""
    if hit.only and hit.only not in counted:
        return False
    if is_c and getattr(rule, "in_c", True) is False:
        return False
    return not hit.callback or any(one in callbacks for one in hit.callback.split(EITHER))


def _counted(path: PurePosixPath) -> tuple[str, ...]:
    suffix = path.suffix.lower()
    if suffix not in HEADER_ENDINGS or path.name.endswith(FORM_ENDING):
        return (SOURCE,)
    is_piece = suffix in PIECE_ENDINGS or path.stem.lower().endswith(_PIECE_STEMS)
    return (HEADER,) if is_piece else (HEADER, GUARDED)


def _finding(hit: Hit, path: str, entity: str, ordinal: int, selection: Selection, rule: Rule) -> Finding:
    severity, certainty, consequence = selection[hit.rule], rule.certainty, rule.consequence
    if hit.consequence is not None and hit.consequence.rank < consequence.rank:
        consequence = hit.consequence
        severity = min(severity, severity_of(consequence, certainty), key=lambda one: one.rank)
    if hit.certainty is not None and hit.certainty.rank <= certainty.rank:
        certainty = hit.certainty
        lowered = severity_of(consequence, certainty, unproven=True)
        severity = min(severity, lowered, key=lambda one: one.rank)
    return Finding(
        rule=hit.rule,
        severity=severity,
        message=hit.message,
        path=path,
        line=hit.line,
        column=hit.column,
        end_line=hit.end_line,
        end_column=hit.end_column,
        entity=entity,
        tags=rule.info.tags,
        tool=TOOL,
        fingerprint=fingerprint(hit.rule, entity, hit.context, ordinal),
        edits=hit.edits,
        consequence=consequence,
        certainty=certainty,
    )


class _Around:
    """The innermost function or class around a line."""

    def __init__(self, entities: Sequence[Entity]) -> None:
        self._inside: dict[str, list[tuple[int, int, str]]] = {}
        for entity in entities:
            if entity.line and entity.kind in (EntityKind.FUNCTION, EntityKind.CLASS):
                self._inside.setdefault(entity.path, []).append((entity.line, entity.end_line, entity.id))
        for spans in self._inside.values():
            spans.sort()

    def innermost(self, path: str, line: int) -> str:
        spans = self._inside.get(path)
        if not spans or not line:
            return ""
        best = min(self._candidates(spans, line), default=None)
        return best[2] if best is not None else ""

    @staticmethod
    def _candidates(spans: Sequence[tuple[int, int, str]], line: int) -> Iterator[tuple[int, int, str]]:
        for start, end, entity in spans[: bisect_right(spans, (line, 1 << 62, ""))]:
            if end >= line:
                yield (end - start, -start, entity)
