"""Every verdict as it stands, time after time: of what is fine and was not looked at, the same object as before."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from roslens.live.standing.measured import Judged
from roslens.live.standing.standing import Standing
from roslens.live.system.topic import Topic
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State, Verdict

_OF_TRAFFIC = (EntityKind.TOPIC, EntityKind.CONNECTION)


class VerdictList:
    """Keeps the verdicts of one monitor, sorted by entity and expectation."""

    def __init__(self) -> None:
        self._listed: list[Standing] = []
        self._sorted: list[Standing] = []
        self._found: list[Verdict] = []
        self._marks: list[list[object]] = [[], [], []]
        self._places: dict[EntityId, list[int]] = {}
        self._restless: set[int] = set()

    def of(self, listed: list[Standing], stirred: Iterable[Topic], still: Iterable[Topic]) -> tuple[Verdict, ...]:
        """Return all verdicts.

        Args:
            listed: what they are about; in the same order while nothing comes or goes.
            stirred: topics that were just brought to the present.
            still: topics that were, too, where nothing was reported that could be new.
        """
        if listed != self._listed:
            self._list(listed)
        again = self._restless | self._moved()
        again.update(place for topic in stirred for place in self._of_topic(topic))
        ordered, found = self._sorted, self._found
        for place in {place for topic in still for place in self._of_topic(topic)} - again:
            one = ordered[place]
            if isinstance(one, Judged) and one.group is not None:
                found[place] = msgspec.structs.replace(found[place], time=one.group.entity.looked)
            else:
                again.add(place)
        for place in again:
            known = found[place] = ordered[place].verdict()
            if known.state is State.OK and known.entity.kind in _OF_TRAFFIC:
                self._restless.discard(place)
            else:
                self._restless.add(place)
        return tuple(found)

    def _moved(self) -> set[int]:
        """Return the places of verdicts whose state or text has changed."""
        ordered = self._sorted
        marks: list[list[object]] = [
            [one.state.state for one in ordered], [one.state.since for one in ordered], [one.details for one in ordered]
        ]  # fmt: skip
        found: set[int] = set()
        for mark, before in zip(marks, self._marks, strict=True):
            if mark != before:
                found.update(place for place, pair in enumerate(zip(mark, before, strict=True)) if pair[0] != pair[1])
        self._marks = marks
        return found

    def _of_topic(self, topic: Topic) -> Iterator[int]:
        places = self._places
        yield from places.get(topic.id, ())
        for connections in topic.connections.values():
            for one in connections:
                yield from places.get(one.id, ())

    def _list(self, listed: list[Standing]) -> None:
        """Take what verdicts are about, because something came or went."""
        known = {one: place for place, one in enumerate(self._sorted)}
        self._listed, self._sorted = listed, sorted(listed, key=lambda one: one.key)
        former = [known.get(one) for one in self._sorted]
        self._found = [
            one.verdict() if place is None else self._found[place]
            for one, place in zip(self._sorted, former, strict=True)
        ]
        # Of what is new nothing is known, so that it is among what moved.
        self._marks = [[None if place is None else mark[place] for place in former] for mark in self._marks]
        now_at = {place: at for at, place in enumerate(former) if place is not None}
        self._restless = {now_at[place] for place in self._restless if place in now_at}
        self._places = {}
        for at, one in enumerate(self._sorted):
            if one.entity.kind in _OF_TRAFFIC:
                self._places.setdefault(one.entity, []).append(at)
