"""A layout of Foxglove (and of Lichtblick, its open fork) made of a reference: diagnostics, and plots with ranges."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import msgspec

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.expectation import Expectation, FieldCheck, FieldMeasure
from roslens.judge.reference.merge_references import constraints_of
from roslens.judge.reference.reference_document import ReferenceConstraint
from roslens.live.publish.exported.constraints import words_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from roslens.judge.ranges.range import Range
    from roslens.judge.reference.expectation import Reference

RATED = "/roslens/rated"
"""Topic of ``roslens watch --publish-statistics``, unless another one is given."""
DIAGNOSTICS = "/diagnostics"
MOST_PLOTS = 12


def foxglove_layout(reference: Reference, rated: str = RATED) -> tuple[str, tuple[str, ...]]:
    """Return the layout as JSON, and texts on the constraints of the reference that it does not plot.

    Args:
        reference: of which it is made.
        rated: topic on which ``roslens_msgs/RatedSignals`` come.
    """
    panels: dict[str, dict[str, Any]] = {
        "DiagnosticSummary!roslens": {
            "topicToRender": DIAGNOSTICS, "minLevel": 0, "pinnedIds": [], "hardwareIdFilter": "", "sortByLevel": True,
        },
        "DiagnosticStatusPanel!roslens": {"topicToRender": DIAGNOSTICS, "collapsedSections": []},
    }  # fmt: skip
    plots: list[str] = []
    left: list[str] = []
    for constraint in constraints_of(reference):
        paths = _plotted(constraint, rated)
        if not paths or len(plots) >= MOST_PLOTS:
            left.append(f"{constraint.details.where or constraint.details.id}: no plot of {words_of(constraint)}")
            continue
        panel = f"Plot!roslens{len(plots)}"
        panels[panel] = _plot(words_of(constraint), paths)
        plots.append(panel)
    sides = _split(["DiagnosticSummary!roslens", "DiagnosticStatusPanel!roslens"], "column")
    layout = _pair(sides, _split(plots, "column"), "row", 40) if plots else sides
    document = {
        "configById": panels, "globalVariables": {}, "userNodes": {}, "playbackConfig": {"speed": 1},
        "layout": layout,
    }  # fmt: skip
    return msgspec.json.format(msgspec.json.encode(document), indent=2).decode() + "\n", tuple(left)


def _plotted(constraint: ReferenceConstraint, rated: str) -> list[str]:
    """Return the paths of what a plot of a constraint shows; none where there can be no plot of it."""
    if isinstance(constraint, Expectation):
        if '"' in constraint.details.id:
            return []
        chosen = f'{rated}.signals[:]{{constraint=="{constraint.details.id}"}}'
        return [f"{chosen}.{field}" for field in ("value", "low", "high")]
    if isinstance(constraint, FieldCheck) and constraint.measure is FieldMeasure.VALUE:
        topic = Pattern.parse(constraint.topic).literal
        return [f"{topic}.{constraint.field}", *_bounds(constraint.range)] if topic else []
    return []


def _plot(title: str, paths: Sequence[str]) -> dict[str, Any]:
    return {
        "title": title,
        "paths": [{"value": path, "enabled": True, "timestampMethod": "receiveTime"} for path in paths],
        "showXAxisLabels": True, "showYAxisLabels": True, "showLegend": True, "legendDisplay": "floating",
        "showPlotValuesInLegend": False, "isSynced": True, "xAxisVal": "timestamp", "sidebarDimension": 240,
        "followingViewWidth": 120,
    }  # fmt: skip


def _bounds(range_: Range) -> list[str]:
    """Return bounds as paths: a number is a level line."""
    return [f"{bound:g}" for bound in (range_.minimum, range_.maximum) if bound is not None]


def _split(panels: Sequence[str], direction: str) -> Any:
    """Return panels side by side, each with the same share."""
    if len(panels) == 1:
        return panels[0]
    return _pair(panels[0], _split(panels[1:], direction), direction, 100 / len(panels))


def _pair(first: Any, second: Any, direction: str, share: float) -> dict[str, Any]:
    return {"first": first, "second": second, "direction": direction, "splitPercentage": round(share, 4)}
