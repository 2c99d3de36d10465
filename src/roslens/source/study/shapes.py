"""Estimated densities of values, as a violin plot draws them: SciPy's Gaussian kernels by Scott's rule."""

from __future__ import annotations

from importlib import import_module
from typing import Any

import numpy as np

from roslens.model.study import Column, Corpus, Shape
from roslens.source.study.measurements import missing

FEWEST = 5
"""Values that a group needs to have a shape."""

_PLACES = 48
_SKEWED = 20.0
"""From this many medians on that the largest value is, values are looked at by their logarithm."""


def shapes_of(corpus: Corpus, by: str = "") -> tuple[Shape, ...]:
    """Return a shape of every column for all, or for each group of at least :data:`FEWEST` different enough values.

    Raises:
        UsageError: SciPy is not installed.
    """
    try:
        stats = import_module("scipy.stats")
    except ImportError as error:
        raise missing(error) from None
    return tuple(shape for column in corpus.columns for shape in _of_column(stats, corpus, column, by))


def _of_column(stats: Any, corpus: Corpus, column: Column, by: str) -> list[Shape]:
    groups: dict[str, list[float]] = {}
    for one in corpus.subjects(column):
        group = getattr(one, by) if by else ""
        if group or not by:
            groups.setdefault(group, []).append(one.values[column.key])
    every = [value for values in groups.values() for value in values]
    skewed = bool(every) and min(every) >= 0 and max(every) > _SKEWED * max(float(np.median(every)), 0.01)
    found = [_shape(stats, column.key, group, np.array(groups[group]), skewed=skewed) for group in sorted(groups)]
    return [shape for shape in found if shape]


def _shape(stats: Any, key: str, group: str, values: Any, *, skewed: bool) -> Shape | None:
    seen = np.log1p(values) if skewed else values
    if len(seen) < FEWEST or np.std(seen) < 1e-9:
        return None
    places = np.linspace(seen.min(), seen.max(), _PLACES)
    heights = stats.gaussian_kde(seen)(places)
    shown = np.expm1(places) if skewed else places
    return Shape(
        key,
        group,
        tuple(round(float(place), 6) for place in shown),
        tuple(round(float(height), 4) for height in heights / heights.max()),
        logarithmic=skewed,
    )
