"""What a row of the tables of distributions means for a package depends on the distribution that it is built for.

Rules on files find all rows; here what matters to no target is dropped, and what does is said with its certainty: only
where the user named the target, and it does not have the thing any more, is it proven.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.distributions.known_distributions import distributions, is_at_least
from roslens.source.distributions.read_changes import Change, Effect, Kind, effect_of, read_changes
from roslens.source.distributions.target import Target
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

BECAUSE = "; this package is built for "
"""What stands in a message before the target that it is about."""


def as_the_target_has(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; those about a row of the tables as it counts for the target of a package."""
    target = view.around.target
    return {path: list(_counted(hits, view, target)) for path, hits in placed.items()}


def _counted(hits: Sequence[Hit], view: PackageView, target: Target) -> Iterator[Hit]:
    for hit in hits:
        if not hit.change:
            yield hit
            continue
        change = read_changes()[hit.change]
        effect = effect_of(change, target)
        if effect is Effect.NONE or change.ros not in view.ros or _is_own(change, view):
            continue
        yield msgspec.structs.replace(
            hit,
            certainty=_certainty(hit, change, effect, target, view),
            # What the target still has builds and starts there.
            consequence=None if effect is Effect.REMOVED else Consequence.HARD_TO_MAINTAIN,
            edits=() if _is_too_new(change, target) else hit.edits,
            message=f"{hit.message}{_because(change, effect, target)}",
        )


def _is_own(change: Change, view: PackageView) -> bool:
    """Return whether the package, or one of the workspace that it depends on, has the thing itself."""
    if change.kind is Kind.HEADER and f"include/{change.name}" in view.listing:
        return True
    return re.split(r"[/:.]", change.name, maxsplit=1)[0] in view.around.own


def _certainty(hit: Hit, change: Change, effect: Effect, target: Target, view: PackageView) -> Certainty:
    # What a rule doubts for a reason of its own is no surer for the target.
    if hit.certainty is Certainty.HEURISTIC or effect is not Effect.REMOVED or view.ros == {1, 2}:
        return Certainty.HEURISTIC
    return Certainty.PROVEN if target.given and target.of(change.ros) else Certainty.LIKELY


def _because(change: Change, effect: Effect, target: Target) -> str:
    """Return who says that the target matters, where that is not plain from the row."""
    if effect is not Effect.REMOVED or not target.of(change.ros):
        return ""
    first = next(one for one in target.of(change.ros) if is_at_least(one, change.removed))
    return f"{BECAUSE}{distributions()[first].title}, as {target.said_by} says"


def _is_too_new(change: Change, target: Target) -> bool:
    """Whether a distribution that is built for lacks what takes the place."""
    names = target.of(change.ros)
    return bool(change.since) and (not names or any(not is_at_least(one, change.since) for one in names))
