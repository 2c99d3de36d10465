"""Reads time lines: what is known of a system from which instant on, and what has to be decided then."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import msgspec

from roslens.judge.documents.document import Section, parse_document, read_document
from roslens.judge.ranges.amount import parse_amount
from roslens.judge.reading.read_common_keys import reading
from roslens.judge.reading.read_condition_tree import BEING_WORDS, seconds
from roslens.judge.reading.read_state_check import LIFECYCLE
from roslens.judge.reference.reference_keys import KINDS
from roslens.model.acting.action_kind import ACTION_KINDS
from roslens.model.acting.condition import Being
from roslens.model.acting.reaction import Result
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.verdict import State
from roslens.plugins.nearest import did_you_mean

WITHIN_S = 0.5
"""How far from its instant a decision may come, by default."""
AFTER_S = 60.0
"""How long a time line continues after its last entry, by default."""
MOST_S = 3600.0
_END = re.compile(r"(exit|signal) [0-9]{1,3}")
_KINDS = (*KINDS, EntityKind.OBSERVER)

TIME_LINE_KEYS = {
    "name": "of the time line, in messages",
    "given": "what is known from an instant on, in any order",
    "until": "when it ends; by default 60 s after the last that is given",
    "done": "what becomes of actions of a kind: `restart: failed`; by default they are done",
    "expect": "every decision that has to be made; without it none may be",
}
DOCUMENT_KEYS = {"tests": "several time lines", **TIME_LINE_KEYS}
GIVEN_KEYS = {
    "at": "from when on, in seconds",
    **{kind.value: f"name of a {kind.value}" for kind in _KINDS},
    "host": "host on which a node is, or a host itself where nothing else is named",
    "is": "how it is",
    "lifecycle": "state of a managed node",
    "value": "value of a parameter",
    "signal": "of the verdict",
    "severity": "of the verdict",
    "cause": "entity that explains the verdict, as `kind:name`",
    "number": "value that was judged",
    "ended": "how the process of a node that is gone ended: `exit 0`, `signal 2`; by default that was not seen",
}
EXPECT_KEYS = {
    "at": "when",
    "within": "how far from that it may be",
    "reaction": "name of the reaction, or its id",
    "action": "kind of the action",
    "entity": "that it is about, as `kind:name`",
    "target": "of the action, as `kind:name`",
}


class Given(msgspec.Struct, frozen=True):
    """What is known of an entity from ``at_s`` on; exactly one of the states is there."""

    at_s: float
    entity: EntityId
    state: State | None = None
    being: Being | None = None
    lifecycle: str = ""
    value: str | None = None
    host: str = ""
    signal: str = "presence"
    severity: Severity = Severity.ERROR
    cause: str = ""
    number: float | None = None
    ended: str = ""


class Expected(msgspec.Struct, frozen=True):
    """A decision that has to be made; what is empty may be anything. ``place`` is ``file:line:column``."""

    at_s: float
    within_s: float = WITHIN_S
    reaction: str = ""
    action: str = ""
    entity: str = ""
    target: str = ""
    place: str = ""


class TimeLine(msgspec.Struct, frozen=True):
    """What is given, what becomes of actions, and what has to be decided; seconds from 0."""

    name: str
    given: tuple[Given, ...]
    until_s: float
    results: Mapping[str, Result]
    expected: tuple[Expected, ...]
    place: str


def read_time_lines(path: Path) -> tuple[TimeLine, ...]:
    """Return the time lines of a file.

    Raises:
        DocumentError: it is none, with its place.
    """
    return _lines(read_document(path, "time line", DOCUMENT_KEYS), path.name)


def parse_time_lines(content: bytes, shown: str) -> tuple[TimeLine, ...]:
    """Return the time lines of a document that is at hand.

    Raises:
        DocumentError: it is none, with its place.
    """
    return _lines(parse_document(content, "time line", DOCUMENT_KEYS, shown=shown), shown)


def _lines(document: Section, name: str) -> tuple[TimeLine, ...]:
    if "tests" not in document:
        return (_line(document, document.text("name", name)),)
    if "given" in document or "expect" in document:
        raise document.fault("tests", "'tests' beside a time line", expected="one of the two")
    rows = document.sections("tests", "time line", TIME_LINE_KEYS)
    return tuple(_line(row, row.text("name", f"{name} {number}")) for number, row in enumerate(rows, 1))


def _line(section: Section, name: str) -> TimeLine:
    given = tuple(_given(row) for row in section.sections("given", "line of `given`", GIVEN_KEYS))
    if not given:
        raise section.fault("given", "a time line in which nothing is given", expected="a list under `given`")
    last = max(one.at_s for one in given)
    until = seconds(section, "until", last + AFTER_S)
    if not last <= until <= MOST_S:
        expected = f"a time from {last:g} s, when the last is given, to {MOST_S:g} s"
        raise section.fault("until", f"the time line ends at {until:g} s", expected=expected)
    return TimeLine(
        name=name,
        given=tuple(sorted(given, key=lambda one: one.at_s)),
        until_s=until,
        results=_results(section),
        expected=tuple(_expected(row) for row in section.sections("expect", "line of `expect`", EXPECT_KEYS)),
        place=str(section.location()),
    )


def _given(section: Section) -> Given:
    kinds = [kind for kind in _KINDS if kind.value in section and not (kind is EntityKind.HOST and _of_node(section))]
    if len(kinds) != 1:
        expected = f"one of {', '.join(kind.value for kind in _KINDS)}"
        raise section.fault("", f"{len(kinds)} entities in a line of `given`", expected=expected)
    entity = EntityId(kinds[0], section.text(kinds[0].value))
    host = section.text("host", "") if _of_node(section) else ""
    said = [key for key in _SAID if key in section]
    if len(said) != 1:
        found = f"{said[1]!r} beside {said[0]!r}" if said else f"nothing said of {entity}"
        raise section.fault(said[1] if said else "", found, expected="one of `is`, `lifecycle` and `value`")
    at = seconds(section, "at", 0.0)
    number = section.text("number", "")
    common = Given(at, entity, host=host, number=reading(section, "number", lambda: float(number)) if number else None)
    return _SAID[said[0]](section, common)


def _valued(section: Section, common: Given) -> Given:
    """Return what is given of a parameter, with its value."""
    entity = common.entity
    if entity.kind is not EntityKind.PARAMETER or not entity.name.rpartition("/")[0]:
        raise section.fault("value", f"'value' of {entity}", expected="it of a parameter, `/node/name`")
    return msgspec.structs.replace(common, value=section.text("value"))


def _in_lifecycle(section: Section, common: Given) -> Given:
    """Return what is given of a node, with its state of the lifecycle."""
    word = section.text("lifecycle")
    if common.entity.kind is not EntityKind.NODE or word not in LIFECYCLE:
        raise section.fault("lifecycle", f"lifecycle is {word!r}", expected=f"of a node one of {', '.join(LIFECYCLE)}")
    return msgspec.structs.replace(common, lifecycle=word)


def _being_or_state(section: Section, common: Given) -> Given:
    """Return what is given of an entity, with whether it is there, or how it is judged."""
    word = section.text("is")
    if word in BEING_WORDS:
        return msgspec.structs.replace(common, being=Being(word), ended=_ended(section, common, word))
    states = [state.value for state in State]
    if word not in states:
        valid = (*states, *BEING_WORDS)
        raise section.fault(
            "is", f"is is {word!r}", expected=f"one of {', '.join(valid)}", advice=did_you_mean(word, valid)
        )
    return msgspec.structs.replace(
        common,
        state=State(word),
        signal=section.text("signal", "presence"),
        severity=section.choice("severity", Severity, Severity.ERROR),
        cause=_entity(section, "cause"),
    )


def _ended(section: Section, common: Given, word: str) -> str:
    text = section.text("ended", "")
    if not text:
        return ""
    if common.entity.kind is not EntityKind.NODE or word != Being.GONE.value:
        raise section.fault("ended", f"'ended' of {common.entity} that is {word}", expected="it of a node that is gone")
    if not _END.fullmatch(text):
        raise section.fault("ended", f"ended is {text!r}", expected="`exit N` or `signal N`")
    return text


_SAID = {"is": _being_or_state, "lifecycle": _in_lifecycle, "value": _valued}


def _of_node(section: Section) -> bool:
    return any(kind.value in section for kind in _KINDS if kind is not EntityKind.HOST)


def _results(section: Section) -> dict[str, Result]:
    keys = {one.key: one.summary for one in ACTION_KINDS}
    table = section.section("done", "table of results", keys)
    return {} if table is None else {key: table.choice(key, Result) for key in table.given()}


def _expected(section: Section) -> Expected:
    action = section.text("action", "")
    kinds = [one.key for one in ACTION_KINDS]
    if action and action not in kinds:
        raise section.fault(
            "action", f"action is {action!r}", expected=f"one of {', '.join(kinds)}", advice=did_you_mean(action, kinds)
        )
    return Expected(
        at_s=reading(section, "at", lambda: parse_amount(section.text("at"), "s")),
        within_s=seconds(section, "within", WITHIN_S),
        reaction=section.text("reaction", ""),
        action=action,
        entity=_entity(section, "entity"),
        target=_entity(section, "target"),
        place=str(section.location()),
    )


def _entity(section: Section, key: str) -> str:
    text = section.text(key, "")
    return str(reading(section, key, lambda: EntityId.parse(text))) if text else ""
