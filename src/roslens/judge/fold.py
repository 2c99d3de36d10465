"""How values go up: from functions and classes to their file, from all of these to the package."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

from roslens.model.entity import Entity, EntityKind
from roslens.model.quantity import Fold, Quantity

_LEVELS = (EntityKind.FUNCTION, EntityKind.CLASS, EntityKind.FILE, EntityKind.PACKAGE)


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


_FOLDS: dict[Fold, Callable[[Sequence[float]], float]] = {
    Fold.SUM: sum,
    Fold.MEAN: _mean,
    Fold.MAX: max,
    Fold.MIN: min,
}


def folded_keys(quantity: Quantity) -> tuple[str, ...]:
    """Return the keys under which the folds of ``quantity`` are stored, in the order of its ``folds``.

    The first is the quantity's own key; each further one is ``key.fold``.
    """
    return tuple(
        quantity.key if place == 0 else f"{quantity.key}.{fold.value}" for place, fold in enumerate(quantity.folds)
    )


def fold(quantity: Quantity, values: Sequence[float]) -> dict[str, float]:
    """Return the value of the whole for every fold of ``quantity``, by key.

    Args:
        quantity: says which folds, see :class:`~roslens.model.quantity.Quantity`.
        values: those of the parts that have one, in a fixed order (sums of floats depend on it).

    Returns:
        Nothing where there are no values: a whole without measured parts is not measured either.
    """
    if not values:
        return {}
    return {key: float(_FOLDS[how](values)) for key, how in zip(folded_keys(quantity), quantity.folds, strict=True)}


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


def fold_parts(quantities: Iterable[Quantity], kind: EntityKind, parts: Sequence[Entity]) -> dict[str, float]:
    """Return what the ``parts`` say about the file or package that they are in.

    Args:
        quantities: what to fold; those that do not go up to ``kind`` are passed over.
        kind: of the whole.
        parts: every entity in the whole, at any depth, in a fixed order.

    Returns:
        Values by key, in the order of ``quantities``.
    """
    by_kind: dict[EntityKind, list[dict[str, float]]] = {}
    for part in parts:
        by_kind.setdefault(part.kind, []).append(part.values)
    folded: dict[str, float] = {}
    for quantity in quantities:
        source = folded_from(quantity, kind)
        if source is None:
            continue
        key = quantity.key
        folded.update(fold(quantity, [values[key] for values in by_kind.get(source, ()) if key in values]))
    return folded
