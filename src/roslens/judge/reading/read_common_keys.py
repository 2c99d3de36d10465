"""What every constraint of a reference has besides what it expects: id, place, severity, group, text, timing."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TypeVar

from roslens.judge.documents.document import Section
from roslens.judge.ranges.amount import parse_amount, parse_limits
from roslens.judge.ranges.range import Range
from roslens.judge.reference.expectation import Details, Timing
from roslens.judge.reference.reference_document import Declared, Defaults, ReferenceConstraint, Scope
from roslens.model.finding import Severity

_ID = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.:-]*\Z")
_LONGEST_ID = 80
_CONTROL = re.compile("[\x00-\x1f\x7f-\x9f]")
Read = TypeVar("Read")


def reading(section: Section, key: str, read: Callable[[], Read]) -> Read:
    """Return what ``read`` returns, with the place of ``key`` added to its error.

    Raises:
        DocumentError: ``read`` raised a ValueError.
    """
    try:
        return read()
    except ValueError as error:
        what, _, expected = str(error).partition(", expected ")
        expected, _, advice = expected.partition(". ")
        raise section.fault(key, f"{key}: {what}", expected=expected, advice=advice) from None


def visible(section: Section, key: str, text: str, *, lines: bool = False) -> str:
    """Return a text that will be shown on terminals and pages.

    Raises:
        DocumentError: it has control characters; with ``lines`` line ends and tabs are none.
    """
    if found := _CONTROL.search(re.sub("[\t\n]", "", text) if lines else text):
        raise section.fault(key, f"{key} has the control character {found[0]!r}", expected="a text without any")
    return text


def read_defaults(section: Section | None, defaults: Defaults) -> Defaults:
    """Return ``defaults`` with the overrides of a section.

    Raises:
        DocumentError: a value is wrong.
    """
    if section is None:
        return defaults
    timing = defaults.timing
    return Defaults(
        severity=section.choice("severity", Severity, defaults.severity),
        group=visible(section, "group", section.text("group", defaults.group)),
        timing=Timing(
            lasting=_seconds(section, "for", timing.lasting),
            recovering=_seconds(section, "recover", timing.recovering),
            margin=_share(section, timing.margin),
            grace=_seconds(section, "grace", timing.grace),
            window=_seconds(section, "window", timing.window),
        ),
    )


def name_of(section: Section, default: str) -> str:
    """Return the name of a constraint, as the document gives it or by default.

    Raises:
        DocumentError: the name has other characters than letters, digits and ``_.:-``.
    """
    name = section.text("id", default)
    if "id" in section and (not _ID.match(name) or len(name) > _LONGEST_ID):
        expected = f"up to {_LONGEST_ID} letters, digits, `_`, `-`, `.` and `:`"
        raise section.fault("id", f"id is {name[:60]!r}", expected=expected)
    return name if len(name) <= _LONGEST_ID else f"{name[: _LONGEST_ID - 1]}…"


def overrides(section: Section) -> bool:
    """Return whether a constraint replaces another.

    Raises:
        DocumentError: ``override`` is neither true nor false, or there is no ``id`` with it.
    """
    word = section.text("override", "false")
    if word not in {"true", "false"}:
        raise section.fault("override", f"override is {word!r}", expected="true or false")
    if word == "true" and "id" not in section:
        raise section.fault("override", "override without an id", expected="the `id` of the constraint to replace")
    return word == "true"


def details_of(section: Section, scope: Scope, name: str, aspect: str, key: str) -> Details:
    """Return what goes with a constraint whose range stands under ``key``.

    Raises:
        DocumentError: a value is wrong.
    """
    own = read_defaults(section, scope.defaults)
    location = section.location(key)
    return Details(
        id=constraint_id(scope.document, name, aspect),
        where=f"{location.path}:{location.line}",
        severity=own.severity,
        group=own.group,
        text=visible(section, "text", section.text("text", ""), lines=True),
        timing=own.timing,
    )


def declared(
    section: Section, scope: Scope, constraint: ReferenceConstraint, name: str, key: str, *, void: bool = False
) -> Declared:
    """Return a constraint with what merging asks for; it stands under ``key`` and expects nothing where ``void``.

    Raises:
        DocumentError: the id or the override is wrong, or it is void and overrides nothing.
    """
    override = overrides(section)
    if void and not override:
        raise section.fault(key, f"{key}: 'any' expects nothing", expected="a range", advice="Remove the line")
    return Declared(
        constraint=constraint,
        name=name,
        aspect=constraint.details.id.removeprefix(f"{scope.document}.{name}."),
        place=str(section.location(key)),
        given="id" in section,
        override=override,
        void=void,
    )


def constraint_id(document: str, name: str, aspect: str) -> str:
    """Return the id of a constraint."""
    return f"{document}.{name}.{aspect}"


def slug(*names: str) -> str:
    """Return names and patterns as one word of an id: ``robot.scan`` for ``/robot/scan``."""
    return ".".join(name.strip("/").replace("/", ".").replace(" ", "_") or "root" for name in names if name)


def squeezed(text: str) -> str:
    """Return a range on one line."""
    return " ".join(text.split())


def plain_range(section: Section, key: str, unit: str) -> Range:
    """Return a range of single values, in ``unit``.

    Raises:
        DocumentError: it is none, or about a percentile.
    """
    text = section.text(key)
    limits = reading(section, key, lambda: parse_limits(text, unit))
    if limits.percentile:
        raise section.fault(key, f"{key}: a percentile in {text!r}", expected="a range of single values")
    return limits.range


def prefixed(scope: Scope, section: Section, default: str) -> str:
    """Return the name of a constraint; one that is given is distinguished by the namespace it was included into."""
    name = name_of(section, default)
    return f"{scope.prefix}.{name}" if scope.prefix and "id" in section else name


def _seconds(section: Section, key: str, default: float) -> float:
    if key not in section:
        return default
    value = reading(section, key, lambda: parse_amount(section.text(key), "s"))
    if value < 0:
        raise section.fault(key, f"{key} is {section.text(key)!r}", expected="a time from 0 on")
    return value


def _share(section: Section, default: float) -> float:
    if "margin" not in section:
        return default
    share = reading(section, "margin", lambda: parse_amount(section.text("margin"), "%", bare=False)) / 100
    if not 0 <= share < 1:
        raise section.fault(
            "margin", f"margin is {section.text('margin')!r}", expected="a share from 0 % to below 100 %"
        )
    return share
