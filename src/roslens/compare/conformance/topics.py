"""Topics by what is published on them: what a recording of ROS 2, which names no node, can be held against."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from roslens.compare.conformance.claim import TOPIC, Claim
from roslens.compare.conformance.plumbing import plumbing
from roslens.model.graph import Role

_ACTIONS = frozenset({Role.ACTION_SERVER.value, Role.ACTION_CLIENT.value})
_ROS1_ACTION = "Action"
_OF_ALL = {"cancel": "actionlib_msgs/GoalID", "status": "actionlib_msgs/GoalStatusArray"}


def _of_action(action: Claim) -> Iterator[Claim]:
    """Yield the topics of an action of ROS 1 as claims, see wiki.ros.org/actionlib."""
    types = {part: f"{action.values['type']}{part.title()}" for part in ("goal", "result", "feedback")} | _OF_ALL
    for part, type_ in types.items():
        yield msgspec.structs.replace(action, name=f"{action.name}/{part}", values={"type": type_})


def topics_of(claims: Iterable[Claim]) -> Iterator[Claim]:
    """Yield a claim for each published topic; for several publishers, what they have in common."""
    published: dict[str, list[Claim]] = {}
    for one in claims:
        if one.kind == Role.PUBLISHER.value and not plumbing(one):
            published.setdefault(one.name, []).append(one)
        elif one.kind in _ACTIONS and one.values.get("type", "").endswith(_ROS1_ACTION):
            for topic in _of_action(one):
                published.setdefault(topic.name, []).append(topic)
    for name, found in published.items():
        best = min(found, key=lambda one: (one.doubt, one.node))
        values = {
            key: value
            for key, value in best.values.items()
            if all(one.values.get(key, value) == value for one in found)
        }
        yield Claim(
            TOPIC, "", name, values, best.sure, best.resolved,
            conditions=() if any(not one.conditions for one in found) else best.conditions,
            place=best.place, given=best.given, remapped=best.remapped,
        )  # fmt: skip
