"""What readers of a live page see of it now: only that has to be of the present four times a second."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

MOST_ROWS = 600
"""Rows and lines of one reader; a screen shows fewer."""
LONGEST_ENTITY = 1000
LASTING_S = 5.0
"""So long everything is seen by who asked for all of it."""


class Seen(NamedTuple):
    """What a reader sees.

    Attributes:
        rows: keys of rows of the tree.
        links: version of the picture and place in its list of links, of lines whose words can be read.
        entities: text forms of ids of what was chosen.
        picture: whether the picture is seen at all.
    """

    rows: frozenset[str] = frozenset()
    links: frozenset[tuple[int, int]] = frozenset()
    entities: frozenset[str] = frozenset()
    picture: bool = False


NOTHING = Seen()


class Sight:
    """Keeps what each reader sees; written by one thread, and read by any."""

    def __init__(self, steady: Callable[[], float]) -> None:
        """``steady`` is a monotonic clock, in seconds."""
        self._steady = steady
        self._streams: dict[object, tuple[str, Seen | None]] = {}
        self._entities: dict[str, float] = {}
        self._whole_until = float("-inf")
        self._all: Seen | None = None

    def enter(self, stream: object, reader: str) -> None:
        """Count a stream that begins; a reader without a name reports nothing, and sees everything."""
        self._streams[stream] = reader, NOTHING if reader else None
        self._join()

    def leave(self, stream: object) -> None:
        """Count a stream no more."""
        self._streams.pop(stream, None)
        self._join()

    def tell(self, reader: str, seen: Seen) -> bool:
        """Take what a reader sees from now on; return whether there is such a reader."""
        mine = [stream for stream, (name, _) in self._streams.items() if reader and name == reader]
        self._streams.update((stream, (reader, seen)) for stream in mine)
        self._join()
        return bool(mine)

    def take_all(self) -> None:
        """Note that a reader has requested everything, and may do so again."""
        self._whole_until = self._steady() + LASTING_S

    def ask(self, entity: str) -> bool:
        """Note a request for an entity; return whether what is known of it may be some seconds old."""
        seen, until = self.seen(), self._steady() + LASTING_S
        self._entities = {one: end for one, end in self._entities.items() if end > until - LASTING_S}
        new = entity not in self._entities
        if len(entity) <= LONGEST_ENTITY and len(self._entities) < MOST_ROWS:
            self._entities[entity] = until
        return new and seen is not None and entity not in seen.entities

    def seen(self) -> Seen | None:
        """Return what any reader sees; None if that is everything or unknown."""
        known, now = self._all, self._steady()
        if known is None or now < self._whole_until:
            return None
        asked = {one for one, until in self._entities.copy().items() if until > now}
        return known._replace(entities=known.entities | asked) if asked else known

    def _join(self) -> None:
        stated = [seen for _, seen in self._streams.values()]
        every = [one for one in stated if one is not None]
        if not stated or len(every) < len(stated):
            self._all = None
            return
        # One value takes the place of another: who asks meanwhile has the old one or the new one.
        self._all = Seen(
            frozenset[str]().union(*(one.rows for one in every)),
            frozenset[tuple[int, int]]().union(*(one.links for one in every)),
            frozenset[str]().union(*(one.entities for one in every)),
            any(one.picture for one in every),
        )


def seen_of(rows: str, links: str, entity: str, picture: str) -> Seen | None:
    """Return what a page reports to see; None if that cannot be read.

    Args:
        rows: keys, with dots between.
        links: ``version:place.place…``, empty where there are none.
        entity: that was chosen, empty where none was.
        picture: ``1`` where the picture is seen.
    """
    keys = rows.split(".") if rows else []
    version, _, rest = links.partition(":")
    places = rest.split(".") if rest else []
    if len(keys) > MOST_ROWS or len(places) > MOST_ROWS or len(entity) > LONGEST_ENTITY:
        return None
    numbers = [version, *places] if places else []
    if not all(one.isascii() and one.isdigit() and len(one) < 10 for one in numbers):
        return None
    return Seen(
        frozenset(keys), frozenset((int(version), int(one)) for one in places),
        frozenset([entity] if entity else []), picture == "1",
    )  # fmt: skip
