"""Margins that are wider than the range that they are about."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from roslens.judge.ranges.range import Range, plain
from roslens.judge.reference.constraint_words import expected_words, subject_words
from roslens.judge.reference.expectation import StateCheck
from roslens.judge.reference.reference_document import ReferenceConstraint

COUNTED = frozenset({"publishers", "subscribers", "misfits"})
"""Signals that are counts, and have no margin: they come back to the bound itself."""


def wide_margins(constraints: Iterable[ReferenceConstraint]) -> Iterator[str]:
    """Yield a warning for each range in which no value is as far inside as its margin asks for."""
    for one in constraints:
        range_, margin = getattr(one, "range", None), one.details.timing.margin
        if not isinstance(range_, Range) or range_.minimum is None or range_.maximum is None or not margin:
            continue
        if isinstance(one, StateCheck) or getattr(one, "quantity", "") in COUNTED:
            continue
        low, high = range_.minimum, range_.maximum
        if low + abs(low) * margin > high - abs(high) * margin and low < high:
            yield (
                f"{one.details.where}: the margin of {plain(100 * margin)} % is wider than the range of "
                f"{subject_words(one)} ({expected_words(one)}): what was wrong counts as fine again in its middle; "
                f"expected a margin that leaves some of the range, or none (`margin: 0 %`)"
            )
