"""A reference drafted from what was observed, for a person to edit: each line with its evidence.

Of several publishers of a topic the messages add up, and the longest of their gaps is that of the topic, as in what
is judged. `draft_lines` says how ranges are chosen.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import pairwise

import msgspec

from roslens.live.drafting.draft_commands import WHY, is_command
from roslens.live.drafting.draft_lines import Line, proposed
from roslens.live.drafting.draft_presence import PLUMBING
from roslens.live.drafting.draft_steps import Steps
from roslens.live.window.observer_rank import RANK
from roslens.model.traffic.tally import Tally

LEAST_MESSAGES = 10
"""Of fewer nothing is drafted."""
LONGEST_S = 600.0
"""Of a tally; what is longer is taken as if all of it came at the end."""


class Drafted(msgspec.Struct, frozen=True):
    """What is proposed of one topic, or of several of one pattern.

    Attributes:
        names: of the topics.
        type: of their messages.
        messages: that came.
        seconds: from the first of them on.
        lines: ranges; none of what comes with events rather than at a rate.
        window: seconds over which these are judged.
        unsteady: of what comes with events, what its rate was, or why it is none in spite of its steady rate.
    """

    names: tuple[str, ...]
    type: str
    messages: int
    seconds: float
    lines: tuple[Line, ...]
    window: float = 0.0
    unsteady: str = ""

    @property
    def rated(self) -> bool:
        """Whether its lines are required."""
        return bool(self.lines) and not self.unsteady


_View = tuple[int, bool, str]
"""How well an observer sees a connection, whether at its subscriber, and which."""


class Observed:
    """Collects the tallies that a reference is drafted from."""

    def __init__(self, step_s: float = 1.0) -> None:
        """Take tallies in steps of ``step_s`` seconds."""
        self.step_s = step_s
        self._steps: dict[str, dict[str, dict[_View, Steps]]] = {}
        self._types: dict[str, str] = {}
        self._number = 0
        self._start: float | None = None

    def add(self, tallies: Iterable[Tally]) -> None:
        """Take the tallies of the next step, of a recording."""
        for tally in tallies:
            self._of(tally).add(tally, ((self._number, 1.0),))
        self._number += 1

    def add_live(self, tallies: Iterable[Tally]) -> None:
        """Take tallies of any stretches of time; their messages are spread over the steps that they cover."""
        for tally in tallies:
            if self._start is None:
                self._start = tally.start
            shares = self._shares(tally.start - self._start, tally.end - self._start)
            if shares:
                self._of(tally).add(tally, shares)
                self._number = max(self._number, shares[-1][0] + 1)

    def _shares(self, start: float, end: float) -> list[tuple[int, float]]:
        """Return the steps that a stretch of time covers, each with its share of the stretch."""
        if end <= 0 or end < start or end - start > LONGEST_S:
            # Before everything else, or of a clock that jumped.
            return []
        start = max(start, 0.0)
        first, last = math.floor(start / self.step_s), max(math.ceil(end / self.step_s) - 1, 0)
        if last <= first:
            return [(first, 1.0)]
        edges = [start, *(number * self.step_s for number in range(first + 1, last + 1)), end]
        spans = pairwise(edges)
        return [(first + place, (after - before) / (end - start)) for place, (before, after) in enumerate(spans)]

    def add_types(self, types: Iterable[tuple[str, str]]) -> None:
        """Take the types of topics by name."""
        self._types.update(types)

    def drafted(self) -> tuple[Drafted, ...]:
        """Return what is proposed, one entry a topic, sorted by name."""
        found = []
        for topic, publishers in sorted(self._steps.items()):
            best = [self._best(views) for name, views in sorted(publishers.items()) if name or len(publishers) == 1]
            spoken = [one for one in best if one.messages >= LEAST_MESSAGES and one.periods and one.time_between]
            if topic in PLUMBING or not spoken:
                continue
            first = min(one.first for one in spoken)
            proposal = proposed([one.track(first, self._number, self.step_s) for one in spoken], self.step_s)
            if proposal is not None:
                messages, seconds = sum(one.messages for one in best), (self._number - first) * self.step_s
                type_ = self._types.get(topic, "")
                unsteady = proposal.unsteady or (WHY if is_command(topic, type_) else "")
                found.append(Drafted((topic,), type_, messages, seconds, proposal.lines, proposal.window, unsteady))
        return tuple(found)

    def left_out(self) -> tuple[str, ...]:
        """Return the topics of which too little was seen."""
        drafted = {name for one in self.drafted() for name in one.names}
        return tuple(sorted({*self._steps, *self._types} - drafted))

    def _of(self, tally: Tally) -> Steps:
        views = self._steps.setdefault(tally.topic, {}).setdefault(tally.publisher, {})
        view = (RANK[tally.observer], bool(tally.subscriber), tally.subscriber)
        return views.setdefault(view, Steps())

    @staticmethod
    def _best(views: dict[_View, Steps]) -> Steps:
        """Return where the traffic of a publisher is seen best: subscribers of one publisher do not add up."""
        return min(views.items(), key=lambda pair: (not pair[1].messages, *pair[0][:2], -pair[1].messages))[1]
