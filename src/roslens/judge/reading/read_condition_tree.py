"""Reads the conditions of reactions: trees of statements about a system."""

from __future__ import annotations

from collections.abc import Callable

import msgspec

from roslens.judge.documents.document import Section
from roslens.judge.patterns.pattern import Pattern
from roslens.judge.ranges.amount import parse_amount
from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_common_keys import reading, visible
from roslens.judge.reading.read_selector import read_selector
from roslens.judge.reading.read_state_check import LIFECYCLE, number_range
from roslens.judge.reference.constraint_words import selector_words
from roslens.judge.reference.reaction_keys import CONDITION_KEYS, STATEMENT_KEYS, TREE_KEYS
from roslens.judge.reference.reference_document import Scope
from roslens.judge.reference.reference_keys import KINDS
from roslens.model.acting.condition import (
    NO_TIME,
    About,
    AllOf,
    AnyOf,
    AtLeast,
    Being,
    Condition,
    Matching,
    Not,
    OverTime,
    Stated,
)
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.selector import Selector
from roslens.model.verdict import State
from roslens.plugins.nearest import did_you_mean

Named = Callable[[Section, str], Condition]
"""Returns the condition that a section names, or fails."""

BAD, WRONG = "bad", "wrong"
VERDICT_WORDS = (*(state.value for state in State), BAD, WRONG)
FORMS = ("all", "any", "not", "at_least", "condition")
_BEINGS = {
    EntityKind.HOST: (Being.THERE, Being.GONE),
    EntityKind.NODE: tuple(one for one in Being if one is not Being.MISFIT),
    EntityKind.PROCESS: (Being.THERE, Being.GONE, Being.STOPPED, Being.HUNG),
    EntityKind.TOPIC: (Being.THERE, Being.GONE, Being.MISFIT),
    EntityKind.SERVICE: (Being.THERE, Being.GONE),
}
BEING_WORDS = tuple(one.value for one in Being)
OTHER_SIGNALS = ("presence", "lifecycle", "value", "age", "change", "difference")


def read_condition_tree(section: Section, scope: Scope, named: Named) -> Condition:
    """Return the condition that a mapping states.

    Args:
        section: the mapping.
        scope: of its document.
        named: finds the condition behind ``condition: NAME``.

    Raises:
        DocumentError: it states nothing, several things at once, or something that cannot be.
    """
    forms = [key for key in FORMS if key in section]
    stated = [key for key in STATEMENT_KEYS if key in section]
    if forms and stated:
        raise section.fault(
            stated[0], f"{stated[0]!r} beside {forms[0]!r}", expected=f"it in a condition below {forms[0]!r}"
        )
    if len(forms) > 1:
        raise section.fault(
            forms[1], f"{forms[1]!r} beside {forms[0]!r}", expected="one of them, the other one below it"
        )
    if not forms and not stated:
        kinds = ", ".join(kind.value for kind in KINDS)
        expected = f"one of {', '.join(FORMS)}, or a statement about one of {kinds}"
        raise section.fault("", "a condition that states nothing", expected=expected)
    time = _time(section, scope, named)
    if not forms:
        return _statement(section, scope, time)
    return _tree(section, scope, named, forms[0], time)


def _tree(section: Section, scope: Scope, named: Named, form: str, time: OverTime) -> Condition:
    place = str(section.location(form))
    for key in TREE_KEYS:
        if key in section and key not in (form, "among" if form == "at_least" else form):
            raise section.fault(key, f"{key!r} beside {form!r}", expected="it with `at_least` only")
    if form == "condition":
        found = named(section, form)
        return found if time == NO_TIME else AllOf((found,), time, place)
    if form == "not":
        part = section.section("not", "condition", CONDITION_KEYS)
        if part is None:
            raise section.fault("", "a `not` of nothing", expected="a condition")
        return Not(read_condition_tree(part, scope, named), time, place)
    parts = _parts(section, scope, named, form)
    if form == "at_least":
        return AtLeast(_least(section, len(parts)), parts, time, place)
    return AllOf(parts, time, place) if form == "all" else AnyOf(parts, time, place)


def _parts(section: Section, scope: Scope, named: Named, form: str) -> tuple[Condition, ...]:
    """Return the conditions that a condition is made of."""
    key = "among" if form == "at_least" else form
    parts = tuple(
        read_condition_tree(part, scope, named) for part in section.sections(key, "condition", CONDITION_KEYS)
    )
    if not parts:
        raise section.fault(form, f"{form!r} of no condition", expected=f"a list of conditions under {key!r}")
    return parts


def _least(section: Section, parts: int) -> int:
    """Return how many of ``parts`` conditions have to hold."""
    count = section.number("at_least") or 0
    if count != int(count) or not 1 <= count <= parts:
        expected = f"a whole number from 1 to {parts}, which are listed in `among`"
        raise section.fault("at_least", f"at_least is {section.text('at_least')!r}", expected=expected)
    return int(count)


def _statement(section: Section, scope: Scope, time: OverTime) -> Stated:
    selector = read_selector(section, scope, "condition")
    given = [key for key in ("is", "lifecycle", "value") if key in section]
    if len(given) != 1:
        found = (
            f"{given[1]!r} beside {given[0]!r}"
            if given
            else f"a condition that does not mention {selector_words(selector)}"
        )
        raise section.fault(given[1] if given else "", found, expected="one of `is`, `lifecycle` and `value`")
    about, states, least, most = _asked(section, selector, given[0])
    for key in ("signal", "severity", "effects"):
        if key in section and about is not About.VERDICT:
            raise section.fault(
                key,
                f"{key!r} beside {given[0]}: {states and states[0]}",
                expected="it with a verdict, such as `is: bad`",
            )
    signal = section.text("signal", "")
    valid = (*scope.known, *OTHER_SIGNALS)
    if signal and signal not in valid:
        raise section.fault(
            "signal",
            f"signal is {signal!r}",
            expected="a signal of a constraint about it",
            advice=did_you_mean(signal, valid),
        )
    quantity = scope.known.get(signal)
    if quantity is not None and selector.kind not in quantity.kinds:
        kinds = " or ".join(kind.value for kind in KINDS if kind in quantity.kinds)
        raise section.fault(
            "signal", f"{signal!r} is not measured of a {selector.kind.value}", expected=f"it of a {kinds}"
        )
    matching = section.choice("match", Matching, Matching.ANY)
    statement = Stated(
        selector=selector,
        about=about,
        states=states,
        quantity=signal,
        severity=section.choice("severity", Severity, Severity.NOTE),
        least=least,
        most=most,
        matching=matching,
        effects=_flag(section, "effects") or False,
        unknown=_flag(section, "unknown"),
        time=time,
        place=str(section.location(selector.kind.value)),
    )
    return msgspec.structs.replace(statement, written=statement_words(statement))


def statement_words(stated: Stated) -> str:
    """Return a statement in words: ``node /lidar is gone``."""
    of = f" ({stated.quantity})" if stated.quantity else ""
    if stated.about is About.VALUE and not stated.states:
        return f"{selector_words(stated.selector)} is in {Range(stated.least, stated.most)}"
    return f"{selector_words(stated.selector)} is {' or '.join(stated.states)}{of}"


def is_literal(selector: Selector) -> bool:
    """Whether a selector can be about one entity alone."""
    return Pattern.parse(selector.name).literal is not None


def _asked(section: Section, selector: Selector, key: str) -> tuple[About, tuple[str, ...], float | None, float | None]:
    states = tuple(visible(section, key, text) for text in section.texts(key))
    if not states:
        raise section.fault(key, f"{key} is empty", expected="one of the states it can be in")
    if key == "value":
        if selector.kind is not EntityKind.PARAMETER:
            raise section.fault(key, f"'value' of a {selector.kind.value}", expected="it of a parameter")
        limits = number_range(states)
        return (
            (About.VALUE, states, None, None) if limits is None else (About.VALUE, (), limits.minimum, limits.maximum)
        )
    if key == "lifecycle":
        if selector.kind is not EntityKind.NODE:
            raise section.fault(key, f"'lifecycle' of a {selector.kind.value}", expected="it of a node")
        _known(section, key, states, LIFECYCLE)
        return About.LIFECYCLE, states, None, None
    beings = tuple(one.value for one in _BEINGS.get(selector.kind, ()))
    _known(section, key, states, (*VERDICT_WORDS, *beings))
    of_being = [state for state in states if state in beings]
    if of_being and len(of_being) < len(states):
        other = next(state for state in states if state not in beings)
        raise section.fault(
            key, f"{other!r} beside {of_being[0]!r}", expected="states of verdicts or others; `any` takes both"
        )
    return (About.BEING if of_being else About.VERDICT), states, None, None


def _known(section: Section, key: str, states: tuple[str, ...], valid: tuple[str, ...]) -> None:
    for state in states:
        if state not in valid:
            expected = f"one of {', '.join(valid)}"
            raise section.fault(key, f"{key} is {state!r}", expected=expected, advice=did_you_mean(state, valid))


def _time(section: Section, scope: Scope, named: Named) -> OverTime:
    of = section.section("of", "condition", CONDITION_KEYS)
    if (of is None) != ("within" not in section):
        key, other = ("of", "within") if of is not None else ("within", "of")
        raise section.fault(key, f"{key!r} without {other!r}", expected="`within: 5 s` and `of: …` together")
    time = OverTime(
        for_s=seconds(section, "for", 0.0),
        within_s=seconds(section, "within", 0.0),
        of=read_condition_tree(of, scope, named) if of is not None else None,
        after_start_s=seconds(section, "after_start", 0.0),
    )
    return NO_TIME if time == NO_TIME else time


def seconds(section: Section, key: str, default: float) -> float:
    """Return a length of time in seconds, ``default`` where the key is not there.

    Raises:
        DocumentError: it is no time, or a negative one.
    """
    if key not in section:
        return default
    value = reading(section, key, lambda: parse_amount(section.text(key), "s"))
    if value < 0:
        raise section.fault(key, f"{key} is {section.text(key)!r}", expected="a time from 0 on")
    return value


def _flag(section: Section, key: str) -> bool | None:
    if key not in section:
        return None
    word = section.text(key)
    if word not in {"true", "false"}:
        raise section.fault(key, f"{key} is {word!r}", expected="true or false")
    return word == "true"
