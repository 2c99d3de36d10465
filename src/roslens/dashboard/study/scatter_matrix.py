"""A scatter matrix: each quantity against each, a mark for each package, sign by group."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np

from roslens.dashboard.study.axis import axis_of
from roslens.model.study import PACKAGE, Column, Study, Subject

CELL = 118
_INSIDE = 104
_EDGE = 7
_MOST_COLUMNS = 6
_MOST_MARKS = 600
SIGNS = ("circle", "square", "triangle", "cross", "diamond")


class Panel(msgspec.Struct, frozen=True):
    """One pair of quantities: where it stands in the matrix, and for each group the path of its marks."""

    row: int
    column: int
    paths: tuple[str, ...]


class ScatterMatrix(msgspec.Struct, frozen=True):
    """Quantities along the diagonal, panels below it; ``left`` are packages that are not drawn."""

    titles: tuple[str, ...]
    groups: tuple[str, ...]
    panels: tuple[Panel, ...]
    left: int


def scatter_matrix(study: Study) -> ScatterMatrix:
    """Return the matrix of the quantities that go together most, of evenly chosen packages where there are many."""
    columns = _columns(study)
    packages = [one for one in study.corpus.packages if all(column.key in one.values for column in columns)]
    step = -(-len(packages) // _MOST_MARKS) or 1
    drawn = packages[::step]
    named = sorted({_group(study, one) for one in drawn})
    groups = named if len(named) <= len(SIGNS) else [""]
    panels = [
        Panel(row, column, _paths(study, drawn, groups, columns[column], columns[row]))
        for row in range(len(columns))
        for column in range(row)
    ]
    titles = tuple(column.title for column in columns)
    return ScatterMatrix(titles, tuple(groups), tuple(panels) if drawn else (), len(packages) - len(drawn))


def _columns(study: Study) -> list[Column]:
    weight: dict[str, float] = {}
    for one in study.correlations:
        for key in (one.one, one.other):
            weight[key] = weight.get(key, 0) + abs(one.spearman.value)
    most = sorted(weight, key=lambda key: (-weight[key], key))[:_MOST_COLUMNS]
    return [column for column in study.corpus.columns if column.of == PACKAGE and column.key in most]


def _group(study: Study, one: Subject) -> str:
    return str(getattr(one, study.by)) if study.by else ""


def _paths(
    study: Study, drawn: Sequence[Subject], groups: Sequence[str], across: Column, up: Column
) -> tuple[str, ...]:
    x, y = ([one.values[column.key] for one in drawn] for column in (across, up))
    left = axis_of(x, _EDGE, _INSIDE, logarithmic=_skewed(x))
    down = axis_of(y, _EDGE, _INSIDE, logarithmic=_skewed(y))
    paths = dict.fromkeys(groups, "")
    for one, value, other in zip(drawn, x, y, strict=True):
        group = _group(study, one)
        sign = SIGNS[groups.index(group) if group in paths else 0]
        paths[group if group in paths else groups[0]] += _mark(sign, left.place(value), CELL - down.place(other))
    return tuple(paths[group] for group in groups)


def _skewed(values: Sequence[float]) -> bool:
    return min(values) >= 0 and max(values) > 20 * max(float(np.median(values)), 0.01)


def _mark(sign: str, x: float, y: float) -> str:
    x, y = round(x, 1), round(y, 1)
    if sign == "circle":
        return f"M{x - 1.6:.1f},{y}a1.6,1.6 0 1 0 3.2,0a1.6,1.6 0 1 0 -3.2,0"
    if sign == "square":
        return f"M{x - 1.5:.1f},{y - 1.5:.1f}h3v3h-3z"
    if sign == "triangle":
        return f"M{x},{y - 2:.1f}l2,3.6h-4z"
    if sign == "cross":
        return f"M{x - 1.8:.1f},{y - 1.8:.1f}l3.6,3.6m0,-3.6l-3.6,3.6"
    return f"M{x},{y - 2.2:.1f}l2.2,2.2l-2.2,2.2l-2.2,-2.2z"
