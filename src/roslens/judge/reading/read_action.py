"""Reads the actions of reactions, against the kinds that there are and what each of them takes."""

from __future__ import annotations

import re
from typing import Any

from roslens.judge.documents.document import Section
from roslens.judge.documents.plain_value import Value
from roslens.judge.patterns.pattern import Pattern
from roslens.judge.ranges.amount import parse_amount
from roslens.judge.reading.read_common_keys import reading, visible
from roslens.judge.reading.read_condition_tree import seconds
from roslens.judge.reference.name_scope import put_under
from roslens.judge.reference.reaction_keys import STEP_KEYS
from roslens.judge.reference.reference_document import Scope
from roslens.judge.reference.template import fields_in
from roslens.model.acting.action_kind import ACTION_KINDS, ActionKind, Argument, ArgumentType, action_kind
from roslens.model.acting.reaction import ActionCall, EscalationStep
from roslens.model.entity import EntityId, EntityKind
from roslens.plugins.nearest import did_you_mean

DO_KEYS = {**{kind.key: kind.summary for kind in ACTION_KINDS}, **STEP_KEYS}
_INTERFACE = re.compile(r"[a-z][a-z0-9_]*/(?:(?:msg|srv|action)/)?[A-Z][A-Za-z0-9]*\Z")
_NAME = re.compile(r"/[A-Za-z0-9_~{}/]*\Z")
_TEMPLATED = (ArgumentType.TEXT, ArgumentType.NAMES, ArgumentType.MAPPING, ArgumentType.ANYTHING)
_TYPES: dict[ArgumentType, tuple[tuple[type, ...], str]] = {
    ArgumentType.NUMBER: ((int, float), "a number"),
    ArgumentType.WHOLE: ((int,), "a whole number"),
    ArgumentType.FLAG: ((bool,), "true or false"),
    ArgumentType.MAPPING: ((dict,), "a table of `key: value` lines"),
}


def read_step(section: Section, scope: Scope) -> EscalationStep:
    """Return one step of a chain.

    Raises:
        DocumentError: there is no action or several, its kind is unknown, or its arguments are wrong.
    """
    kinds = [key for key in section.given() if key not in STEP_KEYS]
    if len(kinds) != 1:
        found = f"{kinds[1]!r} beside {kinds[0]!r}" if kinds else "a step without an action"
        expected = f"one of {', '.join(one.key for one in ACTION_KINDS)}"
        raise section.fault(kinds[1] if kinds else "", found, expected=expected)
    verify = seconds(section, "verify", 0.0) if "verify" in section else None
    if verify == 0:
        raise section.fault("verify", f"verify is {section.text('verify')!r}", expected="a time above 0")
    return EscalationStep(read_action(section, kinds[0], scope), verify)


def read_action(section: Section, key: str, scope: Scope) -> ActionCall:
    """Return the action that stands under ``key``.

    Raises:
        DocumentError: its kind is unknown, an argument is missing, unknown or of another type, or a template names
            what there is not.
    """
    kind = action_kind(key)
    if kind is None:
        raise section.fault(key, f"unknown action {key!r}", expected=f"one of {', '.join(DO_KEYS)}")
    place = str(section.location(key))
    if not section.is_table(key):
        return _short(section, key, kind, scope, place)
    targets = {one.value: f"the {one.value} that it is done to" for one in kind.targets}
    arguments = {one.name: one.text for one in kind.arguments}
    own = section.section(key, f"`{key}`", {**targets, **arguments})
    if own is None:
        raise section.fault(key, f"{key} has no value", expected="its arguments")
    given = [one for one in kind.targets if one.value in own]
    if kind.targets and len(given) != 1:
        expected = " or ".join(f"`{one.value}: NAME`" for one in kind.targets)
        found = "two targets" if given else "no target"
        raise own.fault(given[1].value if given else "", f"`{key}` with {found}", expected=expected)
    target = _target(own, given[0].value, given[0], own.text(given[0].value), scope) if given else None
    return ActionCall(key, target, _arguments(own, kind), place)


def _short(section: Section, key: str, kind: ActionKind, scope: Scope, place: str) -> ActionCall:
    """Return an action that takes one value: ``restart: /lidar``, ``notify: text``."""
    required = [one for one in kind.arguments if one.required]
    if kind.targets and not required:
        return ActionCall(key, _target(section, key, kind.targets[0], section.text(key), scope), {}, place)
    if kind.targets or len(required) != 1 or required[0].type is ArgumentType.MAPPING:
        names = [*(one.value for one in kind.targets[:1]), *(one.name for one in required)]
        expected = f"a table with {', '.join(f'`{name}`' for name in names)}" if names else "`{}`"
        raise section.fault(key, f"{key} is {str(section.value(key))[:60]!r}", expected=expected)
    argument = required[0]
    return ActionCall(key, None, {argument.name: _argument(section, key, argument, section.value(key))}, place)


def _target(section: Section, key: str, kind: EntityKind, text: str, scope: Scope) -> EntityId:
    fields = reading(section, key, lambda: fields_in(visible(section, key, text)))
    if fields:
        if text != f"{{{fields[0]}}}" or fields[0] not in ("entity", "host", "cause"):
            raise section.fault(key, f"{key} is {text!r}", expected="`{entity}`, `{host}`, `{cause}` or a name")
        if (fields[0] == "host") is not (kind is EntityKind.HOST) and fields[0] == "host":
            raise section.fault(key, f"{key} is {text!r}, which is a host", expected=f"a {kind.value}")
        return EntityId(kind, text)
    name = put_under(scope.namespace, text) if kind is not EntityKind.HOST else text
    literal = reading(section, key, lambda: Pattern.parse(name)).literal
    if literal is None:
        advice = "To act on each of several, write `match: each` in the condition and `{entity}` here"
        raise section.fault(
            key, f"{key} {text!r} has wildcards", expected=f"the name of one {kind.value}", advice=advice
        )
    return EntityId(kind, literal)


def _arguments(section: Section, kind: ActionKind) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for argument in kind.arguments:
        if argument.name in section:
            found[argument.name] = _argument(section, argument.name, argument, section.value(argument.name))
        elif argument.required:
            raise section.fault(
                "", f"`{kind.key}` without {argument.name!r}", expected=f"the line `{argument.name}: …`"
            )
    return found


def _argument(section: Section, key: str, argument: Argument, value: Value) -> Any:
    """Return an argument in the form that actions take it.

    Raises:
        DocumentError: it is of another type, none of its choices, or names fields that there are not.
    """
    kind = argument.type
    if value is None:
        raise section.fault(key, f"{argument.name} has no value", expected=argument.text)
    if kind in _TEMPLATED:
        reading(section, key, lambda: fields_in(value))
    if kind is ArgumentType.NAMES:
        return tuple(_chosen(section, key, argument, text) for text in section.texts(key))
    if kind is ArgumentType.DURATION:
        return seconds(section, key, 0.0)
    if kind in _TYPES:
        types, expected = _TYPES[kind]
        if not isinstance(value, types) or (isinstance(value, bool) and bool not in types):
            raise section.fault(key, f"{argument.name} is {str(value)[:60]!r}", expected=expected)
        return value
    if kind is ArgumentType.ANYTHING:
        return value
    return _text(section, key, argument)


def _text(section: Section, key: str, argument: Argument) -> str:
    """Return an argument that is a text, of the form that its type asks for."""
    text = visible(section, key, section.text(key), lines=True)
    kind = argument.type
    if kind is ArgumentType.CHOICE:
        return _chosen(section, key, argument, text)
    if kind is ArgumentType.INTERFACE and not _INTERFACE.match(text):
        expected = "`package/Type`, `package/msg/Type` or `package/srv/Type`"
        raise section.fault(key, f"{argument.name} is {text[:60]!r}", expected=expected)
    if kind in (ArgumentType.TOPIC, ArgumentType.SERVICE):
        reading(section, key, lambda: fields_in(text))
        if not _NAME.match(text):
            raise section.fault(key, f"{argument.name} is {text[:60]!r}", expected="a name that begins with `/`")
    return text


def _chosen(section: Section, key: str, argument: Argument, text: str) -> str:
    if argument.choices and text not in argument.choices:
        advice = did_you_mean(text, argument.choices)
        expected = f"one of {', '.join(argument.choices)}"
        raise section.fault(key, f"{argument.name} is {text[:60]!r}", expected=expected, advice=advice)
    return text


def amount_per(section: Section, key: str) -> tuple[int, float]:
    """Return ``3 per 10 min`` as number and seconds; (0, 0) where the key is not there.

    Raises:
        DocumentError: it does not have that form.
    """
    if key not in section:
        return 0, 0.0
    text = section.text(key)
    count, _, period = text.partition(" per ")
    fault = section.fault(key, f"{key} is {text[:60]!r}", expected="a number and a time, such as `3 per 10 min`")
    if not count.strip().isdecimal() or len(count) > 6 or not period or int(count) < 1:
        raise fault
    written = period if period.strip()[:1].isdecimal() else f"1 {period}"
    per_s = reading(section, key, lambda: parse_amount(written, "s"))
    if per_s <= 0:
        raise fault
    return int(count), per_s
