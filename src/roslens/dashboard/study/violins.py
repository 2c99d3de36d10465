"""Violin plots: for each quantity, each group's estimated density with quartiles and median."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.dashboard.study.axis import Axis
from roslens.model.study import Figures, Shape, Study

WIDTH, HEIGHT = 300, 34
_LEFT = 88
_LENGTH = 200
_HALF = 12.0


class Violin(msgspec.Struct, frozen=True):
    """One group: an outline for a path, the box from the lower to the upper quartile, the median, its middle line."""

    group: str
    outline: str
    lower: float
    upper: float
    median: float
    middle: float
    label: str


class ViolinPlot(msgspec.Struct, frozen=True):
    """All groups of a quantity below each other."""

    title: str
    unit: str
    violins: tuple[Violin, ...]
    ends: tuple[tuple[float, str], ...]
    limits: tuple[float, ...]
    height: int
    logarithmic: bool


def violin_plots(study: Study) -> tuple[ViolinPlot, ...]:
    """Return a plot for each quantity that has a shape, in the order of columns."""
    return tuple(_plots(study))


def _plots(study: Study) -> Iterator[ViolinPlot]:
    figures = {(one.key, one.group): one for one in (study.groups or study.figures)}
    for column in study.corpus.columns:
        shapes = [one for one in study.shapes if one.key == column.key and (one.key, one.group) in figures]
        if not shapes:
            continue
        low, high = min(one.places[0] for one in shapes), max(one.places[-1] for one in shapes)
        axis = Axis(low, high, _LEFT, _LENGTH, shapes[0].logarithmic)
        violins = tuple(
            _violin(shape, figures[shape.key, shape.group], axis, HEIGHT * number + HEIGHT / 2)
            for number, shape in enumerate(shapes)
        )
        limits = [one for one in (column.minimum, column.maximum) if one is not None and low <= one <= high]
        yield ViolinPlot(
            column.title,
            column.unit,
            violins,
            axis.ends(),
            tuple(axis.place(one) for one in limits),
            HEIGHT * len(shapes) + 18,
            axis.logarithmic,
        )


def _violin(shape: Shape, figures: Figures, axis: Axis, middle: float) -> Violin:
    points = [(axis.place(place), height * _HALF) for place, height in zip(shape.places, shape.heights, strict=True)]
    over = " ".join(f"{x},{middle - height:.1f}" for x, height in points)
    under = " ".join(f"{x},{middle + height:.1f}" for x, height in reversed(points))
    text = f"{shape.group or 'all'}: n {figures.n}, median {figures.median:.4g}, "
    text += f"quartiles {figures.lower:.4g} and {figures.upper:.4g}, from {figures.least:.4g} to {figures.most:.4g}"
    return Violin(
        group=shape.group or "all",
        outline=f"M{over} L{under} Z",
        lower=axis.place(figures.lower),
        upper=axis.place(figures.upper),
        median=axis.place(figures.median),
        middle=middle,
        label=text,
    )
