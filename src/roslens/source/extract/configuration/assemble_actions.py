"""Actions of ROS 1 that are written out as five topics: folded into the one thing they are (wiki.ros.org/actionlib)."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from roslens.model.configuration import ConfiguredEndpoint
from roslens.model.graph import Endpoint, Role

_TO_SERVER = ("goal", "cancel")
_TO_CLIENT = ("status", "result", "feedback")
_GOAL = "ActionGoal"


def folded(endpoints: Sequence[ConfiguredEndpoint]) -> list[ConfiguredEndpoint]:
    """Return the endpoints of a node with its actions in place of their topics."""
    kept = list(endpoints)
    topics = {(one.endpoint.role, one.endpoint.name): one for one in endpoints}
    for one in endpoints:
        name, slash, last = one.endpoint.name.rpartition("/")
        if last != "goal" or not slash or not one.endpoint.type.endswith(_GOAL):
            continue
        server = one.endpoint.role is Role.SUBSCRIPTION
        role = Role.ACTION_SERVER if server else Role.ACTION_CLIENT
        mine, theirs = (Role.SUBSCRIPTION, Role.PUBLISHER) if server else (Role.PUBLISHER, Role.SUBSCRIPTION)
        parts = [topics.get((mine, f"{name}/{part}")) for part in _TO_SERVER]
        parts += [topics.get((theirs, f"{name}/{part}")) for part in _TO_CLIENT]
        found = [part for part in parts if part is not None]
        if len(found) < len(parts):
            continue
        kept = [other for other in kept if other not in found]
        kind = one.endpoint.type[: -len("Goal")]
        action = Endpoint(one.endpoint.node, role, name, kind)
        given = one.given.removesuffix("/goal")
        kept.append(msgspec.structs.replace(one, endpoint=action, given=given, queue=-1))
    return kept
