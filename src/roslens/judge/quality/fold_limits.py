"""Several limits of one model that one entity breaks are one finding with several reasons."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import msgspec

from roslens.model.finding import Finding, Severity, fingerprint

SUFFIX = "_limits"
"""Rules of what breaks several limits are called ``<model>.<kind>_limits``."""


EXTREME = "extreme"
"""The model whose limits lie beyond those of others, so that what breaks one breaks theirs."""


def fold_limits(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return findings where those of one model about one entity are one.

    It has the severity, quantity, value and bound of the worst: the most severe, then the one most in excess. The
    ``others`` are all its reasons, the worst first, each behind the id of its rule. What no model makes, or breaks one
    limit only, stays as it is. Notes of other models about an entity that breaks a limit of the model :data:`EXTREME`
    are witnesses of that finding, and reasons of it.
    """
    groups: dict[tuple[str, str], list[Finding]] = {}
    order: list[tuple[str, str] | Finding] = []
    for finding in findings:
        if not finding.model or not finding.entity:
            order.append(finding)
            continue
        key = (finding.model, finding.entity)
        if key not in groups:
            groups[key] = []
            order.append(key)
        groups[key].append(finding)
    notes = _beside_extremes(groups)
    kept = [one for one in order if isinstance(one, Finding) or one not in notes]
    return tuple(one if isinstance(one, Finding) else _witnessed(groups[one], notes, groups) for one in kept)


def _beside_extremes(groups: Mapping[tuple[str, str], Sequence[Finding]]) -> frozenset[tuple[str, str]]:
    """Return the groups of notes about entities that break an extreme limit too."""
    entities = {entity for model, entity in groups if model == EXTREME}
    return frozenset(
        (model, entity)
        for (model, entity), alike in groups.items()
        if model != EXTREME and entity in entities and all(one.severity is Severity.NOTE for one in alike)
    )


def _witnessed(
    alike: list[Finding],
    notes: frozenset[tuple[str, str]],
    groups: Mapping[tuple[str, str], Sequence[Finding]],
) -> Finding:
    folded, entity = _folded(alike), alike[0].entity
    if alike[0].model != EXTREME:
        return folded
    beside = [one for model, about in notes if about == entity for one in groups[model, about]]
    if not beside:
        return folded
    beside.sort(key=lambda one: (-one.excess, one.rule))
    reasons = folded.others or tuple(f"{one.rule}: {one.breach}" for one in alike)
    return msgspec.structs.replace(
        folded,
        others=(*reasons, *(f"{one.rule}: {one.breach}" for one in beside)),
        witnesses=tuple(dict.fromkeys((*folded.witnesses, *(one.rule for one in beside)))),
    )


def limits_broken(finding: Finding) -> tuple[str, ...]:
    """Return the ids of the rules whose limits a finding of a model reports as violated; none for any other finding."""
    if not finding.model:
        return ()
    return tuple(reason.partition(": ")[0] for reason in finding.others) or (finding.rule,)


def _folded(alike: list[Finding]) -> Finding:
    if len(alike) == 1:
        return msgspec.structs.replace(alike[0], breach="")
    worst, *others = sorted(alike, key=lambda one: (-one.severity.rank, -one.excess, one.rule))
    kind = worst.entity.partition(":")[0]
    *reasons, last = (one.breach for one in (worst, *others))
    where = worst.message.removeprefix(worst.breach)
    rule = f"{worst.model}.{kind}{SUFFIX}"
    return msgspec.structs.replace(
        worst,
        rule=rule,
        message=f"{', '.join(reasons)} and {last}{where}",
        tags=tuple(dict.fromkeys(tag for one in (worst, *others) for tag in one.tags)),
        fingerprint=fingerprint(rule, worst.entity),
        others=tuple(f"{one.rule}: {one.breach}" for one in (worst, *others)),
        breach="",
    )
