"""Lines from node to node, each for the topics by which something flows: how a graph of many topics is drawn."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import reduce

import msgspec

from roslens.cli.page.half_lines import Ends, HalfLine, worse

MOST_LINES = 4000
"""Topics that join the most nodes are left out where there would be more."""


class WholeLine(msgspec.Struct):
    """A line between two nodes, and the topics that it stands for."""

    by: list[str]
    line: HalfLine


def whole_lines(
    halves: Mapping[Ends, HalfLine], topics: Collection[str]
) -> tuple[dict[Ends, WholeLine], list[str], list[str]]:
    """Return the lines, the topics that none of them stands for, and those for which there would be too many."""
    giving: dict[str, list[str]] = {topic: [] for topic in topics}
    taking: dict[str, list[str]] = {topic: [] for topic in topics}
    for start, end in sorted(halves):
        if end in giving:
            giving[end].append(start)
        elif start in taking:
            taking[start].append(end)
    by: dict[Ends, list[str]] = {}
    loose, many = [], []
    room = MOST_LINES
    for topic in sorted(topics, key=lambda one: (len(giving[one]) * len(taking[one]), one)):
        pairs = [(start, end) for start in giving[topic] for end in taking[topic] if start != end]
        room -= len(pairs)
        if not pairs:
            loose.append(topic)
        elif room < 0:
            many.append(topic)
        else:
            for pair in pairs:
                by.setdefault(pair, []).append(topic)
    return {pair: WholeLine(mine, joined(*halves_of(pair, mine, halves))) for pair, mine in by.items()}, loose, many


def halves_of(pair: Ends, by: Sequence[str], halves: Mapping[Ends, HalfLine]) -> tuple[list[HalfLine], list[HalfLine]]:
    """Return the lines from one node to each of these topics, and those from the topics to the other."""
    start, end = pair
    return [halves[start, topic] for topic in by], [halves[topic, end] for topic in by]


def joined(gives: Sequence[HalfLine], takes: Sequence[HalfLine], state: str = "") -> HalfLine:
    """Return what is known of the line between two nodes, by the lines to its topics and from them.

    Args:
        gives: lines to its topics.
        takes: lines from them, in the same order.
        state: the worst of all of them, where that is known.
    """
    state = state or reduce(worse, {line.state for lines in (gives, takes) for line in lines})
    if len(takes) == 1:
        give, take = gives[0], takes[0]
        rate, bandwidth = take.rate or give.rate, take.bandwidth or give.bandwidth
        return HalfLine(state, rate, take.latency, bandwidth, take.age, take.lag)
    # Of several topics there is no one rate; how old data is at most is that of the oldest.
    ages = [take.age for take in takes if take.age is not None]
    lags = [take.lag for take in takes if take.lag is not None]
    return HalfLine(state, age=max(ages, default=None), lag=max(lags, default=None))
