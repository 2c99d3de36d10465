"""Verdicts and traffic as messages of roslens_msgs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import Reference
from roslens.live.system.connection_name import connection_ends
from roslens.live.window.signals import BY_KEY
from roslens.model.acting.outgoing import ConnectionStatistics, RatedSignal
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.verdict import State, Verdict

STATES: Mapping[State, int] = {state: number for number, state in enumerate(State)}
"""The constants STATE_* of the definition."""
SEVERITIES: Mapping[Severity, int] = {severity: severity.rank for severity in Severity}
"""The constants SEVERITY_* of the definition."""
_NAN = float("nan")
_KEYS = ("rate", "bandwidth", "period", "jitter", "largest_gap", "latency", "latency_max", "age", "loss")
"""Keys of the signals in ConnectionStatistics, in the order of its fields after the ends."""


def ranges_of(reference: Reference) -> dict[str, Range]:
    """Return the range of each constraint that has one, by its id."""
    found = {one.details.id: one.range for one in reference.expectations}
    found.update((one.details.id, one.range) for one in reference.field_checks)
    found.update((one.details.id, one.range) for one in reference.chains)
    return found


def rated_signals(verdicts: Iterable[Verdict], ranges: Mapping[str, Range]) -> Iterator[RatedSignal]:
    """Return verdicts as messages, in the order given."""
    for one in verdicts:
        fine = ranges.get(one.expectation, Range())
        signal = BY_KEY.get(one.quantity)
        yield RatedSignal(
            one.entity.kind.value, one.entity.name, one.expectation, one.quantity, signal.unit if signal else "",
            _number(one.value), _number(fine.minimum), _number(fine.maximum), STATES[one.state], one.since,
            SEVERITIES[one.severity], one.cause, one.evidence, one.text,
        )  # fmt: skip


def connection_statistics(
    readings: Iterable[tuple[EntityId, Mapping[str, float]]],
) -> tuple[ConnectionStatistics, ...]:
    """Return the traffic of all connections of which values are known, sorted."""
    return tuple(
        ConnectionStatistics(*ends, *(values.get(key, _NAN) for key in _KEYS))
        for ends, values in sorted(
            (connection_ends(entity), values) for entity, values in readings if entity.kind is EntityKind.CONNECTION
        )
    )


def _number(value: float | None) -> float:
    return _NAN if value is None else value
