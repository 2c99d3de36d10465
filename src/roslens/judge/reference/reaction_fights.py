"""Reactions of different documents that would undo each other's work on one entity."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import combinations

from roslens.model.acting.reaction import ActionCall, Reaction
from roslens.model.entity import EntityId
from roslens.model.errors import DocumentError

_RUNS = frozenset({"start", "restart", "load"})
_ENDS = frozenset({"stop", "kill", "unload"})
_ADVICE = "Put both into one chain, or replace one reaction by the other with `override: true`"


def refuse_fights(reactions: Iterable[Reaction]) -> None:
    """Refuse reactions of two documents of which one ends what the other starts, or both set something differently.

    Raises:
        DocumentError: two fight over one entity; the message names both places.
    """
    reported: dict[EntityId, list[tuple[str, ActionCall]]] = {}
    for reaction in reactions:
        document = reaction.name.partition(".")[0]
        for step in reaction.steps:
            target = step.action.target
            if target is not None and "{" not in target.name:
                reported.setdefault(target, []).append((document, step.action))
    for target, calls in sorted(reported.items()):
        for (first, one), (second, other) in combinations(calls, 2):
            if first != second and _fight(one, other):
                raise DocumentError(
                    f"`{other.kind}` of {target}, and `{one.kind}` at {one.place}",
                    where=other.place,
                    expected="documents that do not fight over one entity",
                    advice=_ADVICE,
                )


def _fight(one: ActionCall, other: ActionCall) -> bool:
    kinds = {one.kind, other.kind}
    if kinds & _RUNS and kinds & _ENDS:
        return True
    if kinds == {"lifecycle"}:
        return one.arguments.get("transition") != other.arguments.get("transition")
    same = one.arguments.get("name") == other.arguments.get("name")
    return kinds == {"set_parameter"} and same and one.arguments.get("value") != other.arguments.get("value")
