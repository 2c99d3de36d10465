"""The alarms that a reference should raise in a recording, written down for repeated tests.

.. code-block:: yaml

    kind: reference test
    others: none          # or `allowed`
    alarms:
      - entity: topic:/scan
        quantity: rate    # any, if left out
        state: low        # any, if left out
        at: 30.5 s        # from the start of the recording
        within: 500 ms    # how far off it may be; this is the default
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from pathlib import Path

import msgspec

from roslens.judge.documents.document import Section, read_document
from roslens.judge.ranges.amount import parse_amount
from roslens.live.replay.alarms import Alarm
from roslens.live.window.signals import BY_KEY
from roslens.model.verdict import State
from roslens.plugins.nearest import did_you_mean

DOCUMENT_KIND = "reference test"
KEYS = {
    "kind": f"what the document is: `{DOCUMENT_KIND}`",
    "others": "whether there may be alarms that are not listed: `none` (the default) or `allowed`",
    "alarms": "the alarms that have to be raised",
}
ALARM_KEYS = {
    "entity": "text form of the id of the entity, such as topic:/scan",
    "quantity": "key of the signal; any, if left out",
    "state": "low, high or absent; any, if left out",
    "at": "when the fault begins, from the start of the recording",
    "within": "how far off that may be; by default 500 ms",
}
WITHIN_S = 0.5
_BAD = (State.LOW, State.HIGH, State.ABSENT)


class Others(str, Enum):
    """What is held of alarms that are not listed."""

    NONE = "none"
    ALLOWED = "allowed"


class ExpectedAlarm(msgspec.Struct, frozen=True):
    """One alarm that has to be raised; ``at`` and ``within`` in seconds, ``line`` of the document."""

    entity: str
    at: float
    within: float
    line: int
    quantity: str = ""
    state: State | None = None

    def fits(self, alarm: Alarm, start: float) -> bool:
        """Whether an alarm of a recording that began at ``start`` is this one."""
        return (
            str(alarm.first.entity) in (self.entity, self.entity.replace(":", ":/", 1))
            and self.quantity in ("", alarm.first.quantity)
            and self.state in (None, alarm.first.state, alarm.worst.state)
            and abs(alarm.since - start - self.at) <= self.within
        )


class ExpectedAlarms(msgspec.Struct, frozen=True):
    """A whole document."""

    alarms: tuple[ExpectedAlarm, ...]
    others: Others = Others.NONE


class Outcome(msgspec.Struct, frozen=True):
    """What a recording gave: what was expected and not raised, what was raised and not expected."""

    missing: tuple[ExpectedAlarm, ...]
    surplus: tuple[Alarm, ...]

    @property
    def passed(self) -> bool:
        """Whether everything was as expected."""
        return not self.missing and not self.surplus


def read_expected(path: Path) -> ExpectedAlarms:
    """Read a document.

    Raises:
        DocumentError: it is wrong, with its place.
    """
    document = read_document(path, DOCUMENT_KIND, KEYS)
    if document.text("kind") != DOCUMENT_KIND:
        raise document.fault("kind", f"kind is {document.text('kind')!r}", expected=repr(DOCUMENT_KIND))
    sections = document.sections("alarms", "alarm", ALARM_KEYS)
    return ExpectedAlarms(tuple(map(_alarm, sections)), document.choice("others", Others, Others.NONE))


def compare(alarms: Sequence[Alarm], expected: ExpectedAlarms, start: float) -> Outcome:
    """Hold the alarms of a recording that began at ``start`` against what is expected; each fits one line at most."""
    left = list(alarms)
    missing = []
    for one in expected.alarms:
        found = next((alarm for alarm in left if one.fits(alarm, start)), None)
        if found is None:
            missing.append(one)
        else:
            left.remove(found)
    return Outcome(tuple(missing), () if expected.others is Others.ALLOWED else tuple(left))


def _alarm(section: Section) -> ExpectedAlarm:
    quantity = section.text("quantity", "")
    if quantity and quantity not in BY_KEY and quantity != "presence":
        advice = did_you_mean(quantity, BY_KEY)
        raise section.fault("quantity", f"quantity is {quantity!r}", expected="the key of a signal", advice=advice)
    entity = section.text("entity")
    if ":" not in entity:
        raise section.fault("entity", f"entity is {entity!r}", expected="KIND:NAME, such as topic:/scan")
    state = section.choice("state", State, among=_BAD) if "state" in section else None
    within = _seconds(section, "within") if "within" in section else WITHIN_S
    return ExpectedAlarm(entity, _seconds(section, "at"), within, section.line(), quantity, state)


def _seconds(section: Section, key: str) -> float:
    try:
        return parse_amount(section.text(key), "s")
    except ValueError as error:
        raise section.fault(key, f"{key}: {error}") from None
