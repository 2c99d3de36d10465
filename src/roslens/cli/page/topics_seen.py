"""Which topics somebody sees: by rows of the tree, by lines of the picture that can be read, and by what was chosen."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from roslens.cli.page.half_lines import ends_of
from roslens.dashboard.live.sight import Seen
from roslens.dashboard.live.snapshot import Picture, Snapshot

_TOPIC, _CONNECTION = "topic:", "connection:"


def topics_seen(seen: Seen, shown: Snapshot | None) -> frozenset[str]:
    """Return the names of the topics; ``shown`` is the newest snapshot, of which readers reported what they see."""
    found = {name for entity in seen.entities for name in _topic_of(entity)}
    if shown is None:
        return frozenset(found)
    if seen.rows:
        found.update(name for row in shown.rows if row.key in seen.rows for name in _topic_of(row.entity))
    for version, place in seen.links:
        if version == shown.picture.version and place < len(shown.picture.links):
            found.update(_of_link(shown.picture, place))
    return frozenset(found)


def _of_link(picture: Picture, place: int) -> Iterator[str]:
    link = picture.links[place]
    # A line of several topics has no rate; it shows the age of the oldest of them.
    for entity in (
        *(link.by if len(link.by) == 1 else ()),
        picture.items[link.start].entity,
        picture.items[link.end].entity,
    ):
        yield from _topic_of(entity)


def _topic_of(entity: str) -> Iterator[str]:
    if entity.startswith(_TOPIC):
        yield entity.removeprefix(_TOPIC)
    elif entity.startswith(_CONNECTION):
        # What a page reports as chosen comes from its address, which is untrusted.
        with suppress(ValueError):
            yield ends_of(entity)[0]
