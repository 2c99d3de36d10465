"""Series of times cut into steps: count, sum, squares, least and greatest of each, without a loop over values."""

from __future__ import annotations

import numpy as np

from roslens.live.adapters.bag.block import Ints
from roslens.model.traffic.tally import Moments

_SECOND = 1_000_000_000
_MANY = 64
"""Values of a step from which on a call for each step is cheaper than what is done with all values."""


def edges_of(numbers: Ints) -> Ints:
    """Return where another step begins in step numbers that do not fall."""
    if not len(numbers):
        return numbers[:0]
    return np.concatenate([np.zeros(1, np.int64), np.flatnonzero(numbers[1:] != numbers[:-1]) + 1])


def greatest_of(edges: Ints, values: Ints) -> Ints:
    """Return where the first of the greatest values of each step is; steps begin at ``edges`` and have values."""
    if not len(edges):
        return edges
    if len(edges) * _MANY < len(values):
        ends = [*edges[1:].tolist(), len(values)]
        return np.array([b + int(values[b:e].argmax()) for b, e in zip(edges.tolist(), ends, strict=True)], np.int64)
    greatest = np.repeat(np.maximum.reduceat(values, edges), np.diff(edges, append=len(values)))
    places = np.flatnonzero(values == greatest)
    return places[np.searchsorted(places, edges)]


def moments_of(numbers: Ints, edges: Ints, values: Ints) -> dict[int, Moments]:
    """Return the moments, in seconds, of the nanoseconds of each step.

    Args:
        numbers: of the steps.
        edges: where the values of each step begin; each has some.
        values: nanoseconds.
    """
    if not len(edges):
        return {}
    seconds = values / _SECOND
    columns = (
        np.diff(edges, append=len(values)),
        np.add.reduceat(seconds, edges),
        np.add.reduceat(seconds * seconds, edges),
        np.minimum.reduceat(values, edges) / _SECOND,
        np.maximum.reduceat(values, edges) / _SECOND,
    )
    rows = zip(*(column.tolist() for column in columns), strict=True)
    return {number: Moments(*row) for number, row in zip(numbers.tolist(), rows, strict=True)}
