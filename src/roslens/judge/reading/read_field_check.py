"""Field checks of a reference document: a field's value, its steps, and how far it is from another field."""

from __future__ import annotations

import re
from collections.abc import Iterator

from roslens.judge.documents.document import Section
from roslens.judge.patterns.pattern import Pattern
from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_common_keys import declared, details_of, plain_range, prefixed, slug, squeezed
from roslens.judge.reading.read_selector import read_name, read_pattern
from roslens.judge.reference.expectation import FieldCheck, FieldCondition, FieldMeasure, OtherField
from roslens.judge.reference.reference_document import Declared, Scope
from roslens.judge.reference.reference_keys import TO_KEYS, WHEN_KEYS

_FIELD = re.compile(r"[A-Za-z_]\w*(?:\[\d{1,9}\])*(?:\.[A-Za-z_]\w*(?:\[\d{1,9}\])*)*\Z")
_MEASURES = {"range": FieldMeasure.VALUE, "change": FieldMeasure.CHANGE, "difference": FieldMeasure.DIFFERENCE}


def read_field_checks(section: Section, scope: Scope) -> Iterator[Declared]:
    """Yield what is expected of a field: a constraint for each of ``range``, ``change`` and ``difference``.

    Raises:
        DocumentError: a name, a path or a range is wrong, nothing is expected, or it lacks what it is compared with.
    """
    topic = read_pattern(section, scope, "topic", section.text("topic"))
    literal = Pattern.parse(topic).literal
    field = _path(section)
    other = _other(section, scope)
    measures = {key: measure for key, measure in _MEASURES.items() if key in section}
    if not measures:
        raise section.fault(
            "", "a field check without 'range', 'change' or 'difference'", expected="one of these lines"
        )
    if "difference" in section and other is None:
        advice = "Write `to: {field: …}`, or `to: {topic: …, field: …}` of another topic"
        raise section.fault("difference", "difference without `to`", expected="the other field", advice=advice)
    if other is not None and "difference" not in section:
        raise section.fault("to", "to without a difference", expected="`difference: -0.1..0.1` with it")
    condition = None
    if (when := section.section("when", "condition", WHEN_KEYS)) is not None:
        condition = FieldCondition(
            topic=read_name(when, scope, "topic", when.text("topic")) if "topic" in when else literal or "",
            field=_path(when),
            range=plain_range(when, "range", ""),
        )
    name = prefixed(scope, section, slug("field", literal or topic, field))
    for key, measure in measures.items():
        check = FieldCheck(
            details=details_of(section, scope, name, measure.value, key),
            topic=topic,
            field=field,
            range=plain_range(section, key, ""),
            written=squeezed(section.text(key)),
            condition=condition,
            measure=measure,
            other=other if measure is FieldMeasure.DIFFERENCE else None,
            type=read_pattern(section, scope, "type", section.text("type"), scoped=False) if "type" in section else "",
            without=tuple(read_pattern(section, scope, "without", text) for text in section.texts("without")),
        )
        yield declared(section, scope, check, name, key, void=check.range == Range())


def _other(section: Section, scope: Scope) -> OtherField | None:
    to = section.section("to", "other field", TO_KEYS)
    if to is None:
        return None
    return OtherField(read_name(to, scope, "topic", to.text("topic")) if "topic" in to else "", _path(to))


def _path(section: Section) -> str:
    field = section.text("field")
    if not _FIELD.match(field):
        raise section.fault(
            "field", f"field is {field[:60]!r}", expected="a path such as `pose.position.x` or `ranges[0]`"
        )
    return field
