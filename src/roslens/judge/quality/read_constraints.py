"""The list of constraints in the document of a quality model."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

from roslens.judge.documents.document import Section
from roslens.judge.quality.constraint import Constraint
from roslens.judge.quality.fold import folded_from, folded_keys
from roslens.judge.ranges.range import Range
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.model.quantity import Quantity
from roslens.plugins.nearest import did_you_mean

CONSTRAINT_KEYS = {
    "kind": "kind of entity: package, file, class or function",
    "name": "only entities whose name (of a file: path) matches this glob; `*` matches any text",
    "quantity": "key of the quantity, or of a fold of it (`loc.max`); see `roslens explain KEY`",
    "minimum": "the least value that is fine",
    "maximum": "the greatest value that is fine",
    "id": "distinguishes constraints on one quantity; by default the key of the quantity",
    "severity": "of its findings: note, warning or error",
    "tags": "of its findings, besides those of the model",
    "title": "title of its rules",
    "rationale": "why the threshold is what it is",
    "source": "place of the threshold in the source of the model, or another source",
}

KINDS = (EntityKind.REPOSITORY, EntityKind.PACKAGE, EntityKind.FILE, EntityKind.CLASS, EntityKind.FUNCTION)
_ID = re.compile(r"[a-z][a-z0-9_.-]*\Z")


def read_constraints(document: Section, model: str, known: Mapping[str, Quantity]) -> tuple[Constraint, ...]:
    """Return the constraints of a model's own list.

    Args:
        document: the outermost section of the model.
        model: its name.
        known: everything that can be measured, by key.

    Raises:
        DocumentError: a constraint is wrong, with its place.
    """
    severity = document.choice("severity", Severity, Severity.WARNING)
    tags = document.texts("tags")
    own: list[Constraint] = []
    seen: dict[object, int] = {}
    for section in document.sections("constraints", "constraint", CONSTRAINT_KEYS):
        constraint = _constraint(section, model, known, severity, tags)
        for key, place, words, advice in _identities(constraint):
            if key in seen:
                raise section.fault(
                    place if place in section else "quantity",
                    f"a second constraint {words}",
                    expected=f"one (the first is in line {seen[key]})",
                    advice=advice,
                )
            seen[key] = section.line()
        own.append(constraint)
    return tuple(own)


def _identities(constraint: Constraint) -> Iterable[tuple[object, str, str, str]]:
    """Yield what no other constraint of the model may be too, with the key that says it and words for it."""
    for side in constraint.sides:
        selector = f"{constraint.kind.value} {constraint.name!r}"
        yield (
            (constraint.kind, constraint.name, constraint.quantity, side),
            "quantity",
            f"on the {side}imum of {constraint.quantity!r} of {selector}",
            "Merge the two",
        )
        yield (
            (constraint.id, side),
            "id",
            f"with id {constraint.id!r} and a {side}imum",
            "Give it an `id` of its own",
        )


def _constraint(
    section: Section, model: str, known: Mapping[str, Quantity], severity: Severity, tags: Sequence[str]
) -> Constraint:
    key = section.text("quantity")
    quantity = _quantity(section, key, known)
    kind = section.choice("kind", EntityKind, among=KINDS)
    measured = [one for one in KINDS if _is_measured(quantity, key, one)]
    if kind not in measured:
        raise section.fault(
            "kind",
            f"{key!r} is not measured on a {kind.value}",
            expected=f"kind: {' or '.join(one.value for one in measured)}",
        )
    identity = section.text("id", key.removeprefix(f"{model}."))
    if not _ID.match(identity):
        raise section.fault("id", f"id is {identity!r}", expected="small letters, digits, `_`, `-` and `.`")
    return Constraint(
        id=identity,
        kind=kind,
        quantity=key,
        range=_range(section),
        name=section.text("name", "*"),
        severity=section.choice("severity", Severity, severity),
        tags=tuple(dict.fromkeys((*tags, *section.texts("tags")))),
        title=section.text("title", ""),
        rationale=section.text("rationale", ""),
        source=section.text("source", ""),
        subject=quantity.title if key == quantity.key else f"{quantity.title} ({key.rpartition('.')[2]})",
        meaning=quantity.text,
        unit=quantity.unit,
        decimals=quantity.decimals,
    )


def _quantity(section: Section, key: str, known: Mapping[str, Quantity]) -> Quantity:
    quantity = known.get(key) or known.get(key.rpartition(".")[0])
    if quantity is not None and (quantity.key == key or key in folded_keys(quantity)):
        return quantity
    folds = [fold for one in known.values() for fold in folded_keys(one)[1:]]
    raise section.fault(
        "quantity",
        f"unknown quantity {key!r}",
        expected="a quantity that roslens or one of your plug-ins measures",
        advice=did_you_mean(key, (*known, *folds)) or "`roslens plugins` lists them",
    )


def _is_measured(quantity: Quantity, key: str, kind: EntityKind) -> bool:
    """Whether entities of ``kind`` have a value under ``key``, of their own or folded from their parts."""
    if key == quantity.key and kind in quantity.kinds:
        return True
    return folded_from(quantity, kind) is not None


def _range(section: Section) -> Range:
    minimum, maximum = section.number("minimum"), section.number("maximum")
    if minimum is None and maximum is None:
        raise section.fault("quantity", "a constraint without a threshold", expected="`minimum`, `maximum` or both")
    try:
        return Range(minimum, maximum)
    except ValueError as error:
        place = "minimum" if "minimum" in section else "maximum"
        raise section.fault(place, str(error), expected="finite bounds, the minimum at most the maximum") from None
