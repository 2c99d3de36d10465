"""The lines of a picture whose values alone change: only those that a changed row tells of are made again."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import attrgetter

import msgspec

from roslens.cli.page.half_lines import Ends, HalfLine, fed_by
from roslens.cli.page.whole_lines import halves_of, joined
from roslens.dashboard.live.snapshot import Picture, Row
from roslens.dashboard.live.stirred import stirred
from roslens.model.graph import Graph

_STANDS = attrgetter("key", "state")


class DrawnLines:
    """A picture, and of which rows each line of it tells.

    Attributes:
        picture: the newest one.
    """

    def __init__(
        self, graph: Graph, rows: Sequence[Row], judged: Mapping[str, str], grounds: object, picture: Picture,
        halves: dict[Ends, HalfLine], lines: Sequence[tuple[Ends, Sequence[str]]],
    ) -> None:  # fmt: skip
        """Keep what was drawn.

        Args:
            graph: of which it is.
            rows: of the tree then.
            judged: states of nodes by verdicts.
            grounds: on which it stands.
            picture: that was drawn.
            halves: what is known of every line between a node and a topic.
            lines: ends of each line of the picture, and the topics that it stands for.
        """
        self.picture = picture
        self._graph, self._rows, self._judged, self._grounds = graph, rows, judged, grounds
        self._halves = halves
        self._lines = [halves_of(ends, by, halves) if by else ([], [halves[ends]]) for ends, by in lines]
        self._fed = fed_by(rows)
        self._places: dict[Ends, list[int]] = {}
        for place, ((start, end), by) in enumerate(lines):
            for ends in ((start, end), *((start, topic) for topic in by), *((topic, end) for topic in by)):
                self._places.setdefault(ends, []).append(place)

    def follow(self, graph: Graph, rows: Sequence[Row], judged: Mapping[str, str], grounds: object) -> bool:
        """Draw values that changed; return whether that was all, so that nothing has to be drawn anew."""
        if graph is not self._graph or grounds is not self._grounds or judged != self._judged:
            return False
        if len(rows) != len(self._rows):
            return False
        changed = stirred(self._rows, rows)
        if any(_STANDS(self._rows[place]) != _STANDS(rows[place]) for place in changed):
            return False
        self._rows = rows
        stale: set[int] = set()
        for place in changed:
            ends = self._fed.get(place)
            if ends is not None:
                self._halves[ends].take(rows[place])
                stale.update(self._places.get(ends, ()))
        if stale:
            links = list(self.picture.links)
            for place, line in self._made(stale):
                links[place] = msgspec.structs.replace(
                    links[place], rate=line.rate, latency=line.latency, bandwidth=line.bandwidth, age=line.age,
                    lag=line.lag,
                )  # fmt: skip
            self.picture = msgspec.structs.replace(self.picture, links=tuple(links))
        return True

    def _made(self, places: set[int]) -> Iterator[tuple[int, HalfLine]]:
        for place in places:
            gives, takes = self._lines[place]
            # States are as they were drawn: where one is another, everything is drawn anew.
            yield place, joined(gives, takes, self.picture.links[place].state) if gives else takes[0]
