"""How values go up: from functions and classes to their file, from all of these to the package."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import msgspec

from roslens.model.entity import Entity, EntityKind
from roslens.model.quantity import Fold, Quantity

_LEVELS = (EntityKind.FUNCTION, EntityKind.CLASS, EntityKind.FILE, EntityKind.PACKAGE)

Folding = Callable[[Sequence[float]], float]


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


_FOLDS: dict[Fold, Folding] = {Fold.SUM: sum, Fold.MEAN: _mean, Fold.MAX: max, Fold.MIN: min}


class FoldStep(msgspec.Struct, frozen=True, gc=False):
    """How one quantity goes up to one kind of entity: from the parts of which kind, and to which keys."""

    key: str
    source: EntityKind
    folds: tuple[tuple[str, Folding], ...]


def folded_keys(quantity: Quantity) -> tuple[str, ...]:
    """Return the keys under which the folds of ``quantity`` are stored, in the order of its ``folds``.

    The first is the quantity's own key; each further one is ``key.fold``.
    """
    return tuple(
        quantity.key if place == 0 else f"{quantity.key}.{fold.value}" for place, fold in enumerate(quantity.folds)
    )


def folded_from(quantity: Quantity, kind: EntityKind) -> EntityKind | None:
    """Return the kind of the parts from whose values ``quantity`` goes up to an entity of ``kind``.

    That is the highest kind below ``kind`` on which it is measured: a package's value comes from its
    files where files are measured, else from all its classes or functions (so the mean of a package
    is one over functions, not one over the means of files). None where it is measured on ``kind``
    itself, or does not go up.
    """
    if not quantity.folds or kind in quantity.kinds or kind not in _LEVELS:
        return None
    below = [level for level in _LEVELS[: _LEVELS.index(kind)] if level in quantity.kinds]
    return below[-1] if below else None


def fold_steps(quantities: Iterable[Quantity], kind: EntityKind) -> tuple[FoldStep, ...]:
    """Return how ``quantities`` go up to entities of ``kind``; those that do not are left out."""
    return tuple(
        FoldStep(
            quantity.key,
            source,
            tuple((key, _FOLDS[how]) for key, how in zip(folded_keys(quantity), quantity.folds, strict=True)),
        )
        for quantity in quantities
        if (source := folded_from(quantity, kind)) is not None
    )


def fold_parts(steps: Iterable[FoldStep], parts: Iterable[Entity]) -> dict[str, float]:
    """Return the values of a file or package from those of its ``parts``.

    Args:
        steps: made by :func:`fold_steps` for the kind of the whole.
        parts: every entity in the whole, at any depth, in a fixed order (sums of floats depend on it).

    Returns:
        Values by key, in the order of the steps. A quantity without a single measured part is not
        there: zero would pass as measured.
    """
    by_kind: dict[EntityKind, list[dict[str, float]]] = {kind: [] for kind in _LEVELS}
    for part in parts:
        if part.kind in by_kind:
            by_kind[part.kind].append(part.values)
    folded: dict[str, float] = {}
    for step in steps:
        key = step.key
        values = [one[key] for one in by_kind[step.source] if key in one]
        if values:
            for folded_key, folding in step.folds:
                folded[folded_key] = float(folding(values))
    return folded
