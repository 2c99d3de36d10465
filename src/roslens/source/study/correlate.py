"""Correlations between the quantities of packages, computed by SciPy.

Pearson's coefficient with the interval of Fisher's transformation; Spearman's with the interval of Bonett and Wright
(Sample size requirements for estimating Pearson, Kendall and Spearman correlations, Psychometrika 65, 2000: variance
(1 + r²/2) / (n - 3) of the transformed coefficient); a partial correlation is that of the residuals of ranks on the
ranks of size, with one degree of freedom less. Probabilities are corrected for the number of tests by Benjamini and
Hochberg, for each kind of coefficient apart.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Sequence
from importlib import import_module
from itertools import combinations
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from roslens.model.study import PACKAGE, Column, Corpus, Correlation, Estimate
from roslens.source.study.measurements import missing

FEWEST = 5
"""Packages that two quantities need in common to be compared."""

_Z95 = 1.959963984540054
Values = NDArray[np.float64]


def correlate(corpus: Corpus, leave_out: Sequence[str] = ()) -> tuple[Correlation, ...]:
    """Return how each pair of quantities of packages goes together, in the order of columns.

    Quantities that are the same for all packages, and pairs that fewer than :data:`FEWEST` packages have, are left
    out.

    Args:
        corpus: what was measured.
        leave_out: keys of columns that are no measurements, such as numbers of groups.

    Raises:
        UsageError: SciPy is not installed.
    """
    try:
        stats = import_module("scipy.stats")
    except ImportError as error:
        raise missing(error) from None
    columns = [one for one in corpus.columns if one.of == PACKAGE and one.key not in leave_out]
    found = [_pair(stats, corpus, one, other) for one, other in combinations(columns, 2)]
    kept = [one for one in found if one is not None]
    for kind in ("pearson", "spearman", "partial", "density"):
        kept = _adjusted(stats, kept, kind)
    return tuple(kept)


def _pair(stats: Any, corpus: Corpus, one: Column, other: Column) -> Correlation | None:
    both = [package.values for package in corpus.packages if one.key in package.values and other.key in package.values]
    x, y = _of(both, one.key), _of(both, other.key)
    if len(both) < FEWEST or not (np.ptp(x) and np.ptp(y)):
        return None
    return Correlation(
        one.key,
        other.key,
        len(both),
        _pearson(stats, x, y),
        _spearman(stats, x, y),
        *_sized(stats, corpus, both, one, other),
    )


def _of(rows: Sequence[dict[str, float]], key: str) -> Values:
    return np.array([row[key] for row in rows], dtype=float)


def _pearson(stats: Any, x: Values, y: Values) -> Estimate:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = stats.pearsonr(x, y)
        low, high = found.confidence_interval(0.95)
    return Estimate(float(found.statistic), float(low), float(high), float(found.pvalue), float(found.pvalue))


def _spearman(stats: Any, x: Values, y: Values) -> Estimate:
    found = stats.spearmanr(x, y)
    value = float(found.statistic)
    return _with_interval(value, float(found.pvalue), math.sqrt((1 + value**2 / 2) / (len(x) - 3)))


def _with_interval(value: float, p: float, deviation: float) -> Estimate:
    if abs(value) >= 1:
        return Estimate(value, value, value, p, p)
    middle = math.atanh(value)
    return Estimate(value, math.tanh(middle - _Z95 * deviation), math.tanh(middle + _Z95 * deviation), p, p)


def _sized(
    stats: Any, corpus: Corpus, rows: Sequence[dict[str, float]], one: Column, other: Column
) -> tuple[Estimate | None, Estimate | None]:
    """Return the partial correlation with size held fixed, and that of densities."""
    if corpus.size_key in ("", one.key, other.key):
        return None, None
    sized = [row for row in rows if row.get(corpus.size_key, 0) > 0]
    if len(sized) < FEWEST:
        return None, None
    size, x, y = (_of(sized, key) for key in (corpus.size_key, one.key, other.key))
    density = _defined(_spearman, stats, x / size, y / size) if one.size and other.size else None
    return _partial(stats, x, y, size), density


def _partial(stats: Any, x: Values, y: Values, size: Values) -> Estimate | None:
    ranks = [stats.rankdata(values) for values in (x, y, size)]
    if any(not np.ptp(one) for one in ranks):
        return None
    line = np.column_stack([np.ones(len(size)), ranks[2]])
    left, right = (one - line @ np.linalg.lstsq(line, one, rcond=None)[0] for one in ranks[:2])
    if np.allclose(left, 0) or np.allclose(right, 0):
        return None
    value = float(np.clip(stats.pearsonr(left, right).statistic, -1, 1))
    freedom = len(size) - 3
    if abs(value) >= 1 or freedom < 1:
        return None
    p = float(2 * stats.t.sf(abs(value) * math.sqrt(freedom / (1 - value**2)), freedom))
    return _with_interval(value, p, 1 / math.sqrt(max(1, len(size) - 4)))


def _defined(
    coefficient: Callable[[Any, Values, Values], Estimate], stats: Any, x: Values, y: Values
) -> Estimate | None:
    return coefficient(stats, x, y) if np.ptp(x) and np.ptp(y) else None


def _adjusted(stats: Any, found: Sequence[Correlation], kind: str) -> list[Correlation]:
    given = [(number, estimate) for number, one in enumerate(found) if (estimate := getattr(one, kind))]
    if not given:
        return list(found)
    adjusted = stats.false_discovery_control([estimate.p for _, estimate in given], method="bh")
    made = list(found)
    for (number, estimate), p in zip(given, adjusted, strict=True):
        made[number] = msgspec.structs.replace(
            made[number], **{kind: msgspec.structs.replace(estimate, adjusted=float(p))}
        )
    return made
