"""Duplicated lines."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Sequence

from roslens.model.entity import EntityKind
from roslens.model.quantity import Fold, Quantity

QUANTITY = Quantity(
    key="duplicated_lines",
    title="Duplicated lines",
    unit="lines",
    kinds=(EntityKind.FILE,),
    text="Lines of code that are a copy of others in the same package, or have one there.",
    folds=(Fold.SUM,),
    formula="number of code lines in blocks of at least `counting.duplicate_lines` (10) code lines in a row that "
    "occur again in the package, line by line equal but for white space and comments",
    source="text-based clones of type 1: Baker, On Finding Duplication and Near-Duplication in Large Software "
    "Systems, WCRE 1995; 10 lines as in SonarQube",
    limits="Copies with renamed variables or another layout of lines are not seen. Every copy counts, the first too. "
    "A block and its copy do not overlap. Files are held against files of the same role: own code against own code.",
)


def of_files(files: Sequence[Sequence[int]], window: int) -> list[float]:
    """Return for each file the number of its lines that are duplicated in one of them.

    The cost is linear in the number of lines: only runs of lines that all occur more than once are
    cut into windows, and windows meet in a dictionary.

    Args:
        files: one hash per code line of each file, in order.
        window: the least number of lines of a copy.
    """
    window = max(1, window)
    counts: Counter[int] = Counter()
    for hashes in files:
        counts.update(hashes)
    places: defaultdict[tuple[int, ...], list[tuple[int, int]]] = defaultdict(list)
    for file, hashes in enumerate(files):
        for start, block in _windows(hashes, counts, window):
            places[block].append((file, start))
    marked = [bytearray(len(hashes)) for hashes in files]
    ones = b"\x01" * window
    for occurrences in places.values():
        for file, start in _copies(occurrences, window):
            marked[file][start : start + window] = ones
    return [sum(lines) for lines in marked]


def _windows(hashes: Sequence[int], counts: Counter[int], window: int) -> Iterator[tuple[int, tuple[int, ...]]]:
    run = 0
    for place, line in enumerate(hashes):
        run = run + 1 if counts[line] > 1 else 0
        if run >= window:
            start = place + 1 - window
            yield start, tuple(hashes[start : place + 1])


def _copies(occurrences: list[tuple[int, int]], window: int) -> Iterator[tuple[int, int]]:
    # Occurrences come in order, so the first and the last are the farthest apart.
    (first_file, first), (last_file, last) = occurrences[0], occurrences[-1]
    for file, start in occurrences:
        if first_file != last_file or start - first >= window or last - start >= window:
            yield file, start
