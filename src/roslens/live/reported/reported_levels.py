"""What other monitors report on ``/diagnostics``: levels that changed, as events; values stay out of our verdicts."""

from __future__ import annotations

from collections.abc import Iterable

import msgspec

from roslens.model.graph import Change, Event

TOPIC = "/diagnostics"
OWN = ("roslens: ", "roslens/")
"""Begin the names of our own statuses, which are not reported back to us."""
SAID = "diagnostics: "
"""Begins what such an event says."""
MOST = 10_000
"""Statuses that are followed; further ones are not."""
FLAPS = 6
FLAP_S = 60.0
"""A status that changes more often than so many times in so long is reported as flapping, then once when it rests."""
_LONGEST = 200
_LEVELS = ("OK", "WARN", "ERROR", "STALE")


class Report(msgspec.Struct, frozen=True):
    """A diagnostic_msgs/DiagnosticStatus without its values; levels are those of REP-107, OK 0 to STALE 3."""

    name: str
    level: int
    message: str = ""
    hardware: str = ""


class _Status(msgspec.Struct):
    """What was reported of a status: its level, and how often that changed since when."""

    level: int = 0
    reported: int = 0
    changed: float = 0.0
    since: float = 0.0
    changes: int = 0


class ReportedLevels:
    """Remembers the level of each status by who reports it."""

    def __init__(self) -> None:
        self._statuses: dict[tuple[str, str], _Status] = {}

    def take(self, reporter: str, reports: Iterable[Report], time: float) -> list[Event]:
        """Return an event for each status whose level is another than before; one that begins as OK is none.

        Args:
            reporter: name of the node that publishes them; empty where unknown.
            reports: statuses of one message.
            time: seconds on the observer's clock.
        """
        return [event for report in reports if (event := self._one(reporter, report, time)) is not None]

    def _one(self, reporter: str, report: Report, time: float) -> Event | None:
        if report.name.startswith(OWN):
            return None
        key = (reporter, report.name[:_LONGEST])
        status = self._statuses.get(key)
        if status is None:
            if len(self._statuses) >= MOST:
                return None
            status = self._statuses[key] = _Status(since=time)
        if report.level != status.level:
            if time - status.since > FLAP_S:
                status.since, status.changes = time, 0
            status.level, status.changed = report.level, time
            status.changes += 1
            if status.changes == FLAPS + 1:
                return _event(Change.FLAPPING, reporter, f"{_quoted(report)} changed {FLAPS + 1} times", report, time)
        rests = status.changes <= FLAPS or time - status.changed > FLAP_S
        if status.level == status.reported or not rests:
            return None
        before, status.reported = status.reported, status.level
        said = f"{_quoted(report)} is {level_name(report.level)}, was {level_name(before)}"
        return _event(Change.CHANGED, reporter, said, report, time)


def is_reported(event: Event) -> bool:
    """Return whether an event is the report of another monitor."""
    return event.detail.startswith(SAID)


def level_name(level: int) -> str:
    """Return the word for a level."""
    return _LEVELS[level] if 0 <= level < len(_LEVELS) else f"level {level}"


def _quoted(report: Report) -> str:
    hardware = f" of {_shown(report.hardware)}" if report.hardware else ""
    return f"{_shown(report.name)!r}{hardware}"


def _event(change: Change, reporter: str, said: str, report: Report, time: float) -> Event:
    message = f": {_shown(report.message)}" if report.message else ""
    return Event(time, change, f"node:{reporter}" if reporter else f"topic:{TOPIC}", f"{SAID}{said}{message}")


def _shown(text: str) -> str:
    return "".join(sign if sign.isprintable() else " " for sign in text[:_LONGEST])
