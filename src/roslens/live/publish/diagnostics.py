"""Verdicts as a diagnostic_msgs/DiagnosticArray, which every ROS tool for diagnostics reads.

One status per entity, named ``roslens: <kind> <name>``. Levels are those of REP-107: OK 0, WARN 1, ERROR 2, STALE 3. A
constraint of severity error is ERROR when it is broken, others are WARN; what is unknown is STALE only where nothing at
all is known of the entity. Each journal has a status as well, with the hash of its last entry.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache

from roslens.judge.ranges.amount import amount_text
from roslens.judge.reference.expectation import StateOf
from roslens.live.explain.node_faults import GONE, STOPPED
from roslens.live.window.signals import BY_KEY
from roslens.model.acting.outgoing import Status
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.verdict import State, Verdict
from roslens.store.journals.journal_head import JournalHead

OK, WARN, ERROR, STALE = range(4)
_SILENT = frozenset({"rate", "bandwidth"})
_STATES = frozenset(of.value for of in StateOf)
_PRESENCE = "presence"
_TOO_MANY = {"<= 0": "is there, expected never", "<= 1": "is there more than once, expected once at most"}
_FACTS = frozenset({GONE.id, STOPPED.id})


def own_host(entity: EntityId) -> str:
    """Return the host that is part of the name of an entity; empty if there is none."""
    if entity.kind is EntityKind.HOST:
        return entity.name
    return entity.name.rpartition("/")[0] if entity.kind is EntityKind.PROCESS else ""


def diagnostics(verdicts: Iterable[Verdict], host_of: Callable[[EntityId], str] = own_host) -> tuple[Status, ...]:
    """Return one status for each entity, sorted by name; ``host_of`` returns the host of an entity."""
    of_entity: dict[EntityId, list[Verdict]] = {}
    for verdict in verdicts:
        of_entity.setdefault(verdict.entity, []).append(verdict)
    return tuple(
        _status(entity, found, host_of(entity))
        for entity, found in sorted(of_entity.items(), key=lambda pair: str(pair[0]))
    )


def journal_statuses(journals: Iterable[JournalHead], host: str) -> tuple[Status, ...]:
    """Return one status for each journal of a host: ERROR where its end is not as it was signed."""
    return tuple(
        Status(
            ERROR if one.wrong else OK, f"roslens: journal {one.path}", one.wrong or "ends as it was written", host,
            (("entries", str(one.entries)), ("head", one.hash)),
        )
        for one in journals
    )  # fmt: skip


def _status(entity: EntityId, verdicts: Sequence[Verdict], host: str) -> Status:
    level, message = OK, "ok"
    if verdicts and all(verdict.state in (State.UNKNOWN, State.SUSPENDED) for verdict in verdicts):
        level, message = STALE, "nothing is known" if verdicts[0].state is State.UNKNOWN else "suspended"
    broken = sorted((one for one in verdicts if one.state.bad), key=lambda one: (-_level(one), one.since))
    if broken:
        level = _level(broken[0])
        message = verdict_message(broken[0])
        if len(broken) > 1:
            message += f" (and {len(broken) - 1} more)"
    values = tuple(
        pair
        for verdict in sorted(verdicts, key=lambda one: one.expectation)
        for pair in ((verdict.quantity, _shown(verdict)), (f"{verdict.quantity} state", verdict.state.value))
    )
    return Status(level, f"roslens: {entity.kind.value} {entity.name}", message, host, values)


def verdict_message(verdict: Verdict) -> str:
    """Return what is wrong in one line: ``rate is low: 12.5 Hz, expected 25..35 Hz; check the cable``."""
    if verdict.entity.kind is EntityKind.OBSERVER:
        return f"{verdict.evidence}; {verdict.text}" if verdict.evidence else "reports again"
    if verdict.expectation in _FACTS:
        return f"{verdict.evidence} → {verdict.leads_to}" if verdict.leads_to else verdict.evidence
    if verdict.quantity in _STATES and verdict.state is State.ABSENT:
        said = f"{verdict.quantity} {verdict.evidence}, expected {verdict.range}"
    else:
        said = f"{_judged(verdict)}{_explained(verdict)}"
    return f"{said}; {verdict.text}" if verdict.text else said


def _judged(verdict: Verdict) -> str:
    signal = BY_KEY.get(verdict.quantity)
    subject = signal.title.lower() if signal else verdict.quantity
    if verdict.quantity == _PRESENCE and verdict.state is State.ABSENT:
        # What is behind the first part of the evidence says why, as far as that is known.
        why = verdict.evidence.partition("; ")[2]
        return f"is expected but not there{f': {why}' if why else ''}"
    if verdict.quantity == _PRESENCE:
        return _TOO_MANY.get(verdict.range, "is there")
    if verdict.state is not State.ABSENT:
        return f"{subject} is {verdict.state.value}: {_shown(verdict)}"
    if verdict.quantity in _SILENT:
        return "is silent"
    return f"{subject} is absent" if signal else "is absent"


def _explained(verdict: Verdict) -> str:
    """Return what was expected, and what goes with it."""
    words = f", expected {verdict.range}" if verdict.range and verdict.quantity != _PRESENCE else ""
    if verdict.leads_to:
        words += f" → {verdict.leads_to}"
    if verdict.cause:
        words += f" (because of {verdict.cause})"
    return words


def _level(verdict: Verdict) -> int:
    if not verdict.state.bad:
        return OK
    return ERROR if verdict.severity is Severity.ERROR else WARN


def _shown(verdict: Verdict) -> str:
    if verdict.value is None:
        return "unknown"
    signal = BY_KEY.get(verdict.quantity)
    return _amount(float(f"{verdict.value:.4g}"), signal.unit if signal else "")


# Of four digits the same come again and again, and all of them are written every second.
_amount = lru_cache(maxsize=65536)(amount_text)
