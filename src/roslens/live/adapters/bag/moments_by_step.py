"""Series of values cut into steps: count, sum, squares, least and greatest of each, without a loop over values."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from roslens.live.adapters.bag.block import Ints
from roslens.model.tally import Moments


def edges_of(numbers: Ints) -> Ints:
    """Return where another step begins in step numbers that do not fall."""
    if not len(numbers):
        return numbers[:0]
    return np.concatenate([np.zeros(1, np.int64), np.flatnonzero(numbers[1:] != numbers[:-1]) + 1])


def greatest_by_step(numbers: Ints, values: Ints) -> dict[int, int]:
    """Return where the first of the greatest values of each step is; ``numbers`` as for :func:`moments_by_step`."""
    if not len(numbers):
        return {}
    edges = edges_of(numbers)
    greatest = np.repeat(np.maximum.reduceat(values, edges), np.diff(edges, append=len(numbers)))
    places = np.flatnonzero(values == greatest)
    firsts = places[edges_of(numbers[places])]
    return dict(zip(numbers[firsts].tolist(), firsts.tolist(), strict=True))


def moments_by_step(numbers: Ints, values: npt.NDArray[np.float64]) -> dict[int, Moments]:
    """Return the moments of the values of each step; ``numbers`` are the steps of the values and do not fall."""
    if not len(numbers):
        return {}
    edges = edges_of(numbers)
    columns = (
        np.diff(edges, append=len(numbers)),
        np.add.reduceat(values, edges),
        np.add.reduceat(values * values, edges),
        np.minimum.reduceat(values, edges),
        np.maximum.reduceat(values, edges),
    )
    rows = zip(*(column.tolist() for column in columns), strict=True)
    return {number: Moments(*row) for number, row in zip(numbers[edges].tolist(), rows, strict=True)}
