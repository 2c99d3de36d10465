"""A dashboard of Grafana made of a reference: what is wrong, how each constraint stood, each value with its range."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import msgspec

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.expectation import Expectation, Selector
from roslens.judge.reference.pattern_expression import expression_of
from roslens.live.publish.exported.constraints import ALARMS, by_group, of_reference, quoted, words_of
from roslens.live.publish.prometheus import metric_name
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.verdict import State

if TYPE_CHECKING:
    from roslens.judge.ranges.range import Range
    from roslens.judge.reference.expectation import Reference
    from roslens.judge.reference.reference_document import ReferenceConstraint

SCHEMA_VERSION = 39
"""Of dashboards, as Grafana 10.4 and later read it; newer ones carry older forms over by themselves."""
_UNITS = {"Hz": "hertz", "s": "s", "B": "bytes", "B/s": "Bps", "%": "percent", "degC": "celsius", "": "short"}
_SOURCE = {"type": "prometheus", "uid": "${datasource}"}
_LEGEND = "{{topic}}{{node}}{{host}}{{service}} {{publisher}} {{subscriber}}"
_FINE, _BAD, _UNKNOWN = "#0072B2", "#D55E00", "#6E7781"
_COLORS = {
    State.OK: _FINE, State.SUSPENDED: "#9AA4AF", State.UNKNOWN: _UNKNOWN, State.LOW: "#E69F00",
    State.HIGH: "#E69F00", State.ABSENT: _BAD,
}  # fmt: skip
_WIDTH, _PLOT_WIDTH, _PLOT_HEIGHT = 24, 12, 8


def grafana_dashboard(reference: Reference) -> tuple[str, tuple[str, ...]]:
    """Return the dashboard as JSON, and texts on the constraints of the reference that it does not plot."""
    panels = _Panels()
    mine = of_reference(reference)
    _overview(panels, mine)
    left: list[str] = []
    for group, constraints in by_group(reference):
        panels.row(group or reference.title or reference.name)
        for one in constraints:
            plotted = _plot(one)
            if isinstance(plotted, str):
                left.append(plotted)
            else:
                panels.add(_PLOT_WIDTH, _PLOT_HEIGHT, plotted)
    dashboard = {
        "title": f"roslens: {reference.title or reference.name}",
        "uid": f"roslens-{reference.name}"[:40],
        "description": f"Made of {', '.join(reference.documents) or reference.name} by `roslens reference export`.",
        "tags": ["roslens", "ros"],
        "timezone": "browser",
        "schemaVersion": SCHEMA_VERSION,
        "editable": True,
        "refresh": "5s",
        "time": {"from": "now-15m", "to": "now"},
        "templating": {
            "list": [{"name": "datasource", "type": "datasource", "query": "prometheus", "label": "Source"}]
        },
        "panels": panels.made,
    }
    return msgspec.json.format(msgspec.json.encode(dashboard), indent=2).decode() + "\n", tuple(left)


class _Panels:
    """Places panels one after the other on a grid of 24 columns."""

    def __init__(self) -> None:
        self.made: list[dict[str, Any]] = []
        self._x = self._y = self._tallest = 0

    def add(self, width: int, height: int, panel: dict[str, Any]) -> None:
        if self._x + width > _WIDTH:
            self._break()
        place = {"x": self._x, "y": self._y, "w": width, "h": height}
        self.made.append({"id": len(self.made) + 1, "gridPos": place, **panel})
        self._x += width
        self._tallest = max(self._tallest, height)

    def row(self, title: str) -> None:
        self._break()
        self.add(_WIDTH, 1, {"type": "row", "title": title, "collapsed": False, "panels": []})
        self._break()

    def _break(self) -> None:
        self._y += self._tallest
        self._x = self._tallest = 0


def _overview(panels: _Panels, mine: str) -> None:
    alarms = "|".join(ALARMS)
    bad = f'roslens_state{{{mine},state=~"{alarms}"}}'
    first = f'roslens_state{{{mine},state=~"{alarms}",cause=""}}'
    panels.add(4, 4, _number("Wrong", f"count({bad}) or vector(0)", _BAD))
    panels.add(4, 4, _number("First causes", f"count({first}) or vector(0)", _BAD))
    panels.add(4, 4, _number("Not judged", f'count(roslens_state{{{mine},state="unknown"}}) or vector(0)', _UNKNOWN))
    panels.add(
        12, 8,
        {
            "type": "table", "title": "Current violations", "datasource": _SOURCE,
            "targets": [{**_target(bad), "instant": True, "range": False, "format": "table"}],
            "transformations": [
                {"id": "organize", "options": {"excludeByName": {"Time": True, "Value": True, "__name__": True}}}
            ],
            "fieldConfig": {"defaults": {}, "overrides": []}, "options": {"showHeader": True},
        },
    )  # fmt: skip
    numbered = " or ".join(
        f'roslens_state{{{mine},state="{state.value}"}} * {place}' for place, state in enumerate(State)
    )
    mappings = {
        str(place): {"text": state.value, "color": _COLORS[state], "index": place} for place, state in enumerate(State)
    }
    panels.add(
        _WIDTH, 10,
        {
            "type": "state-timeline", "title": "How each constraint stood", "datasource": _SOURCE,
            "targets": [
                {
                    **_target(f"max by (kind, name, quantity) ({numbered})"),
                    "legendFormat": "{{kind}} {{name}} {{quantity}}",
                }
            ],
            "fieldConfig": {
                "defaults": {
                    "mappings": [{"type": "value", "options": mappings}],
                    "color": {"mode": "thresholds"}, "thresholds": {"mode": "absolute", "steps": [_step(None, _FINE)]},
                },
                "overrides": [],
            },
            "options": {"mergeValues": True, "showValue": "auto", "rowHeight": 0.8},
        },
    )  # fmt: skip


def _number(title: str, expression: str, color: str) -> dict[str, Any]:
    steps = [_step(None, _FINE), _step(1, color)]
    return {
        "type": "stat", "title": title, "datasource": _SOURCE, "targets": [_target(expression)],
        "fieldConfig": {"defaults": {"thresholds": {"mode": "absolute", "steps": steps}}, "overrides": []},
        "options": {"reduceOptions": {"calcs": ["lastNotNull"]}, "colorMode": "value"},
    }  # fmt: skip


def _plot(constraint: ReferenceConstraint) -> dict[str, Any] | str:
    """Return a panel of the value that a constraint is about with its range; or why there is none."""
    words = words_of(constraint)
    if not isinstance(constraint, Expectation) or constraint.quantity not in BY_KEY:
        # Being there, states and fields are in the timeline above: they have no number of their own.
        return _standing(constraint)
    matchers = matchers_of(constraint)
    if matchers is None:
        where = constraint.details.where or constraint.details.id
        return f"{where}: no plot of {words}: Prometheus has no such expression"
    signal = BY_KEY[constraint.quantity]
    selected = f"{metric_name(constraint.quantity)}{{{','.join(matchers)}}}"
    percentile = (
        f" The constraint is about the {constraint.percentile:g}th percentile." if constraint.percentile else ""
    )
    return {
        "type": "timeseries", "title": words, "datasource": _SOURCE,
        "description": f"{signal.text}{percentile} {constraint.details.text} ({constraint.details.where})".strip(),
        "targets": [{**_target(selected), "legendFormat": _LEGEND}],
        "fieldConfig": {
            "defaults": {
                "unit": _UNITS[signal.unit], "custom": {"thresholdsStyle": {"mode": "line+area"}, "spanNulls": False},
                "thresholds": {"mode": "absolute", "steps": list(_steps(constraint.range))},
                "color": {"mode": "palette-classic"},
            },
            "overrides": [],
        },
        "options": {"legend": {"displayMode": "list", "placement": "bottom"}, "tooltip": {"mode": "multi"}},
    }  # fmt: skip


def _standing(constraint: ReferenceConstraint) -> dict[str, Any]:
    states = "|".join(ALARMS)
    expression = f'count(roslens_state{{expectation={quoted(constraint.details.id)},state=~"{states}"}}) or vector(0)'
    return {**_number(words_of(constraint), expression, _BAD), "description": constraint.details.text}


def matchers_of(constraint: Expectation) -> list[str] | None:
    """Return the matchers of the metric of a constraint; None where one of its patterns is none of RE2."""
    selector = constraint.selector
    kind = selector.kind
    if kind is EntityKind.PROCESS:
        return [f"host=~{quoted('.+')}", f"pid=~{quoted('.+')}"]
    found = []
    for label, pattern in _patterns(selector):
        matcher = _matcher(label, pattern)
        if matcher is None:
            return None
        found.append(matcher)
    if kind is EntityKind.TOPIC:
        # A topic and its connections have metrics of one name; those of a topic name no node.
        found = [one for one in found if one.startswith("topic")] + ['publisher=""']
    if kind is EntityKind.CONNECTION and not selector.publisher:
        found.append('publisher!=""')
    for pattern in selector.without:
        without = expression_of(pattern)
        if without is not None:
            found.append(f"{_label(kind)}!~{quoted(without)}")
    return found


def _label(kind: EntityKind) -> str:
    """Return the label that has the name of entities; a connection is called after its topic."""
    return "topic" if kind is EntityKind.CONNECTION else kind.value


def _patterns(selector: Selector) -> list[tuple[str, str]]:
    """Return the patterns of a selector by the label that they are about."""
    asked = {"publisher": selector.publisher, "subscriber": selector.subscriber, _label(selector.kind): selector.name}
    return sorted((label, pattern) for label, pattern in asked.items() if pattern)


def _matcher(label: str, pattern: str) -> str | None:
    literal = Pattern.parse(pattern).literal
    if literal is not None:
        return f"{label}={quoted(literal)}"
    expression = expression_of(pattern)
    return None if expression is None else f"{label}=~{quoted(expression)}"


def _steps(range_: Range) -> Iterator[dict[str, Any]]:
    low, high = range_.minimum, range_.maximum
    yield _step(None, "transparent" if low is None else _BAD)
    if low is not None:
        yield _step(low, "transparent")
    if high is not None:
        yield _step(high, _BAD)


def _step(value: float | None, color: str) -> dict[str, Any]:
    return {"color": color, "value": value}


def _target(expression: str) -> dict[str, Any]:
    return {"refId": "A", "datasource": _SOURCE, "expr": expression}
