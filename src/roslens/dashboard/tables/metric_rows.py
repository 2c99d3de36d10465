"""The metrics of a package, each against the bounds of each model that knows it."""

from __future__ import annotations

import statistics
from collections.abc import Sequence

from roslens.dashboard.address import PageRef
from roslens.dashboard.charts.figures import number
from roslens.dashboard.site import Site
from roslens.dashboard.tables.table import Cell, Column, Table
from roslens.judge.quality.constraint import Constraint
from roslens.judge.quality.field import Field, distributions_of, load_field
from roslens.judge.quality.select import matcher, name_of
from roslens.judge.ranges.rate import rate
from roslens.model.entity import Entity, EntityKind
from roslens.model.verdict import State

_ORDER = (EntityKind.PACKAGE, EntityKind.FILE, EntityKind.CLASS, EntityKind.FUNCTION)
_MANY = {
    EntityKind.FUNCTION: "functions",
    EntityKind.CLASS: "classes",
    EntityKind.FILE: "files",
    EntityKind.PACKAGE: "packages",
}


def metrics_table(site: Site, entities: Sequence[Entity]) -> Table:
    """Return one row per quantity and kind of entity: how many, mean, most, and how many break each model's bound."""
    by_kind: dict[EntityKind, list[Entity]] = {kind: [] for kind in _ORDER}
    for entity in entities:
        by_kind.setdefault(entity.kind, []).append(entity)
    shown = [(key, kind) for key in site.quantities for kind in _ORDER if kind in site.quantities[key].kinds]
    models = [
        model
        for model in site.models
        if any((constraint.quantity, constraint.kind) in shown for constraint in model.constraints)
    ]
    field = load_field()
    standing: set[str] = set()
    of_package = by_kind[EntityKind.PACKAGE][0].values if by_kind[EntityKind.PACKAGE] else {}
    rows = []
    for key, kind in shown:
        quantity = site.quantities[key]
        values = [entity.values[key] for entity in by_kind[kind] if key in entity.values]
        if not values:
            continue
        single = kind is EntityKind.PACKAGE
        mean_digits = quantity.decimals if single else max(1, quantity.decimals)
        mean = statistics.fmean(values)
        verdicts = (_verdict(site, model.name, kind, key, by_kind[kind]) for model in models)
        rows.append(
            (
                Cell(quantity.title, ref=PageRef("metric", key, query=(("kind", kind.value),)), hint=quantity.text),
                Cell(quantity.unit),
                Cell("the package" if single else f"{len(values):,} {_MANY[kind]}"),
                Cell(mean, text=number(mean, mean_digits)),
                Cell(None if single else max(values), text="" if not single else " "),
                _standing(field, key, None if key in standing else of_package.get(key)),
                *verdicts,
            )
        )
        standing.add(key)
    columns = (
        Column("quantity", "Metric"),
        Column("unit", "Unit"),
        Column("of", "Of"),
        Column("mean", "Value or mean", "number", decimals=1),
        Column("max", "Most", "number"),
        Column("field", "Field", "number", hint=f"percentile of the package among {field.packages:,} ROS packages"),
        *(Column(f"model_{model.name}", model.name, "number", hint=model.title) for model in models),
    )
    return Table("metrics", "Metrics", columns, tuple(rows), total=len(rows), empty="Nothing was measured.")


def _standing(field: Field, key: str, value: float | None) -> Cell:
    """Return how many of a hundred packages of the field have a smaller value than the package."""
    distribution = distributions_of(EntityKind.PACKAGE, field.name).get(key)
    if value is None or distribution is None:
        return Cell(None, text=" ")
    percentile = distribution.percentile(value)
    hint = f"{value:.4g} for the package: {percentile:.0f} of 100 packages of the field {field.name} have less"
    return Cell(round(percentile, 1), text=f"{percentile:.0f} %", hint=hint)


def _verdict(site: Site, model: str, kind: EntityKind, key: str, entities: Sequence[Entity]) -> Cell:
    """Return how many entities break what the model asks; an empty cell where it asks nothing."""
    for other, constraint in site.constraints_on(kind, key):
        if other.name == model:
            return _broken(constraint, key, entities)
    return Cell(None, text=" ")


def _broken(constraint: Constraint, key: str, entities: Sequence[Entity]) -> Cell:
    meant = matcher(constraint.name)
    ratings = [
        rate(entity.values[key], constraint.range)
        for entity in entities
        if key in entity.values and (meant is None or meant(name_of(entity)))
    ]
    high, low = ratings.count(State.HIGH), ratings.count(State.LOW)
    rating = State.HIGH if high else State.LOW if low else State.OK
    return Cell(
        high + low,
        rating=str(rating.value),
        hint=f"asked: {constraint.range}; {high + low} of {len(ratings)} outside",
        text=f"{constraint.range}: {high + low:,}" if high + low else str(constraint.range),
    )
