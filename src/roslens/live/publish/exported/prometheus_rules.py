"""Alerting rules of Prometheus, one for each constraint of a reference.

They ask for the verdicts that ``roslens watch --prometheus`` serves, not for values: what has to last how long,
with which hysteresis and grace, the monitor has judged already, so that no rule has a ``for`` of its own.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import yaml

from roslens.live.publish.exported.constraints import ALARMS, by_group, of_reference, quoted, words_of

if TYPE_CHECKING:
    from roslens.judge.reference.expectation import Reference
    from roslens.judge.reference.reference_document import ReferenceConstraint

NOT_HEARD, NOT_JUDGED, JOURNAL_CHANGED = "RoslensNotHeard", "RoslensNotJudged", "RoslensJournalChanged"
_CUT = "roslens_journal_entries < max_over_time(roslens_journal_entries[1d])"
_BAD = "|".join(ALARMS)
_HEAD = """\
# Alerting rules made from the reference {name} by `roslens reference export --prometheus`.
# Scrape `roslens watch --prometheus PORT`.
# Each is about a verdict, which has already lasted as long as the reference requires.
"""


def prometheus_rules(reference: Reference) -> str:
    """Return the rules as YAML."""
    groups = [
        {
            "name": f"roslens.{reference.name}.{group}" if group else f"roslens.{reference.name}",
            "rules": [_rule(one, reference) for one in constraints],
        }
        for group, constraints in by_group(reference)
    ]
    groups.append({"name": f"roslens.{reference.name}.monitor", "rules": _of_monitor(reference)})
    text = yaml.safe_dump({"groups": groups}, sort_keys=False, allow_unicode=True, width=110)
    return _HEAD.format(name=reference.name) + str(text)


def alert_name(constraint: ReferenceConstraint) -> str:
    """Return the name of the alert of a constraint: of letters, digits and underscores alone."""
    return f"Roslens_{re.sub('[^a-zA-Z0-9]+', '_', constraint.details.id).strip('_')}"


def _rule(constraint: ReferenceConstraint, reference: Reference) -> dict[str, Any]:
    details = constraint.details
    annotations = {
        "summary": "{{ $labels.kind }} {{ $labels.name }}: {{ $labels.quantity }} is {{ $labels.state }}"
        + ("; expected: " + _literal(words_of(constraint))),
        "cause": "{{ with $labels.cause }}follows from {{ . }}{{ end }}",
    }
    if details.text:
        annotations["description"] = _literal(details.text)
    if details.where:
        annotations["constraint"] = _literal(details.where)
    labels = {"severity": details.severity.value, "reference": reference.name}
    if details.group:
        labels["group"] = _literal(details.group)
    expression = f'roslens_state{{expectation={quoted(details.id)},state=~"{_BAD}"}} == 1'
    return {"alert": alert_name(constraint), "expr": expression, "labels": labels, "annotations": annotations}


def _of_monitor(reference: Reference) -> list[dict[str, Any]]:
    labels = {"severity": "error", "reference": reference.name}
    unknown = f'roslens_state{{{of_reference(reference)},severity="error",state="unknown"}} == 1'
    return [
        {
            "alert": NOT_HEARD,
            "expr": "absent(roslens_records_total)",
            "for": "30s",
            "labels": labels,
            "annotations": {"summary": "No monitor reports the state of the robot: it is unknown."},
        },
        {
            "alert": NOT_JUDGED,
            "expr": unknown,
            "for": "5m",
            "labels": {**labels, "severity": "warning"},
            "annotations": {
                "summary": "{{ $labels.kind }} {{ $labels.name }}: {{ $labels.quantity }} is not known for 5 min"
            },
        },
        {
            "alert": JOURNAL_CHANGED,
            "expr": f"roslens_journal_whole == 0 or {_CUT}",
            "labels": labels,
            "annotations": {
                "summary": "{{ $labels.journal }}: its end is not as it was written; `roslens journal --verify`"
            },
        },
    ]


def _literal(text: str) -> str:
    """Return a text that templates of Prometheus take as it is."""
    return text.replace("{{", '{{ "{{" }}')
