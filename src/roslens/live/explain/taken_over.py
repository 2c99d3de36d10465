"""What was wrong before its node was gone or stopped, and is explained by that from then on.

A topic that was slow may have had any reason. Once its only publisher is gone it is silent because of that, whatever
was wrong before, and so is all that followed from it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from roslens.live.system.connection_name import connection_ends
from roslens.live.system.world import World
from roslens.model.entity import EntityId, EntityKind


def taken_over(
    causes: Mapping[EntityId, EntityId], since: Mapping[EntityId, float], faulty: Mapping[EntityId, float], world: World
) -> dict[EntityId, EntityId]:
    """Return the causes with nodes that are gone or stopped as those of what they alone provided.

    Args:
        causes: by when faults began.
        since: when the fault of each bad entity began.
        faulty: nodes that are gone or stopped, and since when.
        world: what is known.
    """
    if not faulty:
        return dict(causes)
    nodes = {entity: node for entity in since if (node := _provider(entity, since[entity], faulty, world)) is not None}
    found = {}
    for entity in since:
        cause = nodes.get(entity, causes.get(entity))
        if cause is not None:
            # What followed from a topic follows from what explains that; nodes explain themselves, or each other.
            node = nodes.get(cause, cause)
            found[entity] = causes.get(node, node)
    return found


def _provider(entity: EntityId, began: float, faulty: Mapping[EntityId, float], world: World) -> EntityId | None:
    """Return the node without which nothing comes of an entity that was bad before; None where others provide it."""
    lost = [node for node in _providers(entity, faulty, world) if faulty[node] >= began]
    return min(lost, key=lambda node: (faulty[node], node), default=None)


def _providers(entity: EntityId, faulty: Mapping[EntityId, float], world: World) -> Iterator[EntityId]:
    """Yield the faulty nodes that provide an entity; none while another one does."""
    nodes = [EntityId(EntityKind.NODE, name) for name in _names(entity, world)]
    lost = [node for node in nodes if node in faulty]
    topic = world.topics.get(entity.name) if entity.kind is EntityKind.TOPIC else None
    left = topic is not None and not topic.publishers
    if left or len(lost) == len(nodes):
        yield from lost


def _names(entity: EntityId, world: World) -> Iterable[str]:
    if entity.kind is EntityKind.TOPIC:
        topic = world.topics.get(entity.name)
        return (topic.publishers or topic.former) if topic is not None else ()
    if entity.kind is EntityKind.CONNECTION:
        return filter(None, (connection_ends(entity)[1],))
    if entity.kind in (EntityKind.SERVICE, EntityKind.ACTION):
        return (one.name for one in world.upstream(entity))
    return ()
