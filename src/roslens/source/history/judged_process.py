"""Quality models on what histories say: bounds on revisions, churn, ownership and the like."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from roslens.judge.quality.quality_model import QualityModel
from roslens.judge.quality.thresholds import judge_entities
from roslens.model.entity import Entity, EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.finding import Finding
from roslens.model.process import RepositoryProcess
from roslens.model.quantity import Quantity
from roslens.source.forge.quantities import FORGE_QUANTITIES
from roslens.source.history.metrics.table import PROCESS_QUANTITIES

BOUNDABLE: Mapping[str, Quantity] = {**PROCESS_QUANTITIES, **FORGE_QUANTITIES}
"""Quantities of processes by key; a model may name them as any other."""


def judged_process(models: Sequence[QualityModel], process: Sequence[RepositoryProcess]) -> tuple[Finding, ...]:
    """Return a finding for each repository, package and file that breaks a bound on its process."""
    if not any(one.quantity in BOUNDABLE for model in models for one in model.constraints):
        return ()
    return judge_entities(models, list(_entities(process)))


def not_judged(models: Sequence[QualityModel]) -> tuple[Failure, ...]:
    """Return, where no history was asked, which bounds of models nobody looked at."""
    bound = sorted({one.quantity for model in models for one in model.constraints if one.quantity in BOUNDABLE})
    if not bound:
        return ()
    named = sorted(model.name for model in models if any(one.quantity in BOUNDABLE for one in model.constraints))
    return (
        Failure(
            "models",
            f"bounds on {', '.join(bound)} were not judged (quality model {', '.join(named)})",
            "the Git history",
            "Run with --process-metrics, or set `metrics = true` below [process] in roslens.toml",
            partial=True,
        ),
    )


def _entities(process: Sequence[RepositoryProcess]) -> Iterator[Entity]:
    for one in process:
        kinds = (
            (EntityKind.REPOSITORY, {one.path: one.values}),
            (EntityKind.PACKAGE, one.packages),
            (EntityKind.FILE, one.files),
        )
        for kind, found in kinds:
            for name, values in sorted(found.items()):
                path = name if kind is EntityKind.FILE else ""
                yield Entity(str(EntityId(kind, name)), kind, name, path, values=values)
