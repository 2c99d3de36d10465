"""Values against the thresholds of quality models: findings for what breaks them, ratings for what is shown."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import inf

import msgspec

from roslens.judge.quality.constraint import CONSEQUENCE, MAX, Constraint
from roslens.judge.quality.quality_model import TOOL, QualityModel, rule_id, tags_of
from roslens.judge.quality.select import matcher, name_of
from roslens.judge.ranges.range import Range
from roslens.judge.ranges.rate import rate
from roslens.model.entity import Entity, EntityKind
from roslens.model.finding import Finding, Severity, fingerprint
from roslens.model.verdict import State


class Rated(msgspec.Struct, frozen=True):
    """A value, the range that a model wants it in, and where it stands to it."""

    quantity: str
    value: float
    range: Range
    rating: State
    model: str


class _Limit(msgspec.Struct, frozen=True):
    """One side of one constraint, with everything its findings share."""

    constraint: Constraint
    side: str
    bound: float
    matches: Callable[[str], bool] | None
    model: str
    rule: str
    severity: Severity
    tags: tuple[str, ...]

    def breaks(self, value: float) -> bool:
        return value > self.bound if self.side == MAX else value < self.bound


class _Watch(msgspec.Struct, frozen=True):
    """All limits on one quantity; between ``low`` and ``high`` a value breaks none of them."""

    quantity: str
    low: float
    high: float
    limits: tuple[_Limit, ...]


def judge_entities(models: Sequence[QualityModel], entities: Sequence[Entity]) -> tuple[Finding, ...]:
    """Return a finding for each value that is outside the range of a constraint.

    Args:
        models: whose constraints hold.
        entities: with their values; one without a value for a quantity breaks no constraint on it.

    Returns:
        Findings in the order of the entities, then of the models and their constraints.
    """
    watches = _watches(models)
    found: list[Finding] = []
    for entity in entities:
        values = entity.values
        for watch in watches.get(entity.kind, ()):
            value = values.get(watch.quantity)
            if value is not None and not watch.low <= value <= watch.high:
                found.extend([_finding(limit, entity, value) for limit in watch.limits if _holds(limit, entity, value)])
    return tuple(found)


def rate_values(
    models: Sequence[QualityModel], kind: EntityKind, values: Mapping[str, float], *, name: str = ""
) -> tuple[Rated, ...]:
    """Return where values stand to the ranges of all models.

    Args:
        models: whose constraints to show.
        kind: of the entity that has the values.
        values: by key of quantity.
        name: of the entity (a file's path); where it is not given, constraints on certain names are left out.

    Returns:
        One rating for each constraint whose quantity has a value, in the order of the models.
    """
    return tuple(
        Rated(one.quantity, values[one.quantity], one.range, rate(values[one.quantity], one.range), model.name)
        for model in models
        for one in model.constraints
        if one.kind is kind and one.quantity in values and _is_about(one, name)
    )


def _is_about(constraint: Constraint, name: str) -> bool:
    matches = matcher(constraint.name)
    return matches is None or (bool(name) and matches(name))


def _holds(limit: _Limit, entity: Entity, value: float) -> bool:
    return limit.breaks(value) and (limit.matches is None or limit.matches(name_of(entity)))


def _finding(limit: _Limit, entity: Entity, value: float) -> Finding:
    joint = "of" if entity.kind is EntityKind.FILE else "in"
    breach = limit.constraint.breach_text(value, limit.side)
    return Finding(
        rule=limit.rule,
        severity=limit.severity,
        message=f"{breach} {joint} {name_of(entity)}",
        path=entity.path,
        line=entity.line,
        end_line=entity.end_line,
        entity=entity.id,
        tags=limit.tags,
        tool=TOOL,
        fingerprint=fingerprint(limit.rule, entity.id),
        quantity=limit.constraint.quantity,
        value=value,
        bound=limit.bound,
        model=limit.model,
        breach=breach,
        consequence=CONSEQUENCE,
        certainty=limit.constraint.certainty,
    )


def _watches(models: Sequence[QualityModel]) -> dict[EntityKind, tuple[_Watch, ...]]:
    limits: dict[EntityKind, dict[str, list[_Limit]]] = {}
    for model in models:
        for constraint in model.constraints:
            for side in constraint.sides:
                of_kind = limits.setdefault(constraint.kind, {})
                of_kind.setdefault(constraint.quantity, []).append(_limit(model, constraint, side))
    return {
        kind: tuple(_watch(quantity, ones) for quantity, ones in by_quantity.items())
        for kind, by_quantity in limits.items()
    }


def _limit(model: QualityModel, constraint: Constraint, side: str) -> _Limit:
    return _Limit(
        constraint=constraint,
        side=side,
        bound=constraint.bound(side),
        matches=matcher(constraint.name),
        model=model.name,
        rule=rule_id(model, constraint, side),
        severity=constraint.severity,
        tags=tags_of(model, constraint),
    )


def _watch(quantity: str, limits: Sequence[_Limit]) -> _Watch:
    return _Watch(
        quantity=quantity,
        low=max((one.bound for one in limits if one.side != MAX), default=-inf),
        high=min((one.bound for one in limits if one.side == MAX), default=inf),
        limits=tuple(limits),
    )
