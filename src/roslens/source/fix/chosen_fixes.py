"""Which of the edits of findings are made together: those of one finding all or none, and none over another's."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Iterable, Sequence
from itertools import pairwise

import msgspec

from roslens.model.edit import Edit
from roslens.model.finding import Finding


class Chosen(msgspec.Struct, frozen=True):
    """Findings whose edits are made, and those whose edits would change what another one changes."""

    made: tuple[Finding, ...]
    overlapping: tuple[Finding, ...]

    def edits(self, path: str) -> tuple[Edit, ...]:
        """Return the edits of a file."""
        return tuple(sorted({edit for one in self.made for edit in one.edits if edit.path == path}))

    @property
    def paths(self) -> tuple[str, ...]:
        """The files that are changed, sorted."""
        return tuple(sorted({edit.path for one in self.made for edit in one.edits}))


def chosen_fixes(findings: Iterable[Finding]) -> Chosen:
    """Return which findings are mended at once.

    Of two that overlap the one wins whose first edit stands first, then the one whose rule has the lower name; so the
    same findings always lead to the same choice. The same edit of two findings is made once and mends both.
    """
    taken: dict[str, list[tuple[int, int]]] = {}
    known: set[Edit] = set()
    made: list[Finding] = []
    overlapping: list[Finding] = []
    for one in sorted(findings, key=_order):
        new = [edit for edit in one.edits if edit not in known]
        if any(_overlaps(edit, taken.get(edit.path, ())) for edit in new) or _overlap_each_other(one.edits):
            overlapping.append(one)
            continue
        for edit in new:
            known.add(edit)
            insort(taken.setdefault(edit.path, []), (edit.start, edit.end))
        made.append(one)
    return Chosen(tuple(made), tuple(overlapping))


def _order(finding: Finding) -> tuple[str, int, int, str, str]:
    first = min(finding.edits)
    return (first.path, first.start, first.end, finding.rule, finding.message)


def _overlaps(edit: Edit, taken: Sequence[tuple[int, int]]) -> bool:
    """Return whether an edit changes what a taken one does; to stand beside each other is no harm."""
    at = bisect_left(taken, (edit.start, edit.start))
    if at and taken[at - 1][1] > edit.start:
        return True
    for start, end in taken[at:]:
        if start > edit.end or (start == edit.end and edit.start < edit.end):
            return False
        # At one place: two insertions, or one in front of what is replaced, stand beside each other.
        if not (start == end == edit.start or edit.start == edit.end == start):
            return True
    return False


def _overlap_each_other(edits: Sequence[Edit]) -> bool:
    ordered = sorted(edits)
    return any(one.path == other.path and one.end > other.start for one, other in pairwise(ordered))
