"""Lines from node to node, each for the topics by which something flows: how a graph of many topics is drawn."""

from __future__ import annotations

from collections.abc import Collection, Mapping

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
    lines: dict[Ends, WholeLine] = {}
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
                _join(lines, pair, topic, halves[pair[0], topic], halves[topic, pair[1]])
    return lines, loose, many


def joined(pair: Ends, by: Collection[str], halves: Mapping[Ends, HalfLine]) -> HalfLine:
    """Return what is known of the line between two nodes by these topics."""
    lines: dict[Ends, WholeLine] = {}
    for topic in by:
        _join(lines, pair, topic, halves[pair[0], topic], halves[topic, pair[1]])
    return lines[pair].line


def _join(lines: dict[Ends, WholeLine], pair: Ends, topic: str, give: HalfLine, take: HalfLine) -> None:
    state = worse(give.state, take.state)
    known = lines.get(pair)
    if known is None:
        rate, bandwidth = take.rate or give.rate, take.bandwidth or give.bandwidth
        lines[pair] = WholeLine([topic], HalfLine(state, rate, take.latency, bandwidth, take.age, take.lag))
        return
    known.by.append(topic)
    line = known.line
    line.state = worse(line.state, state)
    # Of several topics there is no one rate; how old data is at most is told of the oldest.
    line.rate = line.bandwidth = line.latency = ""
    line.age, line.lag = _older(line.age, take.age), _older(line.lag, take.lag)


def _older(one: float | None, other: float | None) -> float | None:
    return max((value for value in (one, other) if value is not None), default=None)
