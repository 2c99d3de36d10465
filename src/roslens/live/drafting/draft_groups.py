"""Topics that mean the same for several things, joined under one pattern: ``/camera_{left,right}/image``."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

from roslens.judge.ranges.range import Range
from roslens.live.drafting.draft import Drafted
from roslens.live.drafting.draft_lines import Line

ALIKE = 1.05
"""Topics whose typical rates differ by at most this factor are alike: the wider band still shows a loss of a third."""


def grouped(drafts: Iterable[Drafted]) -> tuple[Drafted, ...]:
    """Join what differs in one segment of its name only and is alike in type and values; sorted by first name."""
    waiting = sorted(drafts, key=lambda one: one.names)
    found: list[Drafted] = []
    buckets: dict[tuple[object, ...], list[Drafted]] = defaultdict(list)
    for one in waiting:
        if not one.rated:
            continue
        segments = one.names[0].split("/")
        for place in range(1, len(segments)):
            key = (one.type, len(segments), place, *segments[:place], "", *segments[place + 1 :])
            buckets[key].append(one)
    taken: set[str] = set()
    for members in sorted(buckets.values(), key=lambda group: (-len(group), group[0].names)):
        free = [one for one in members if one.names[0] not in taken]
        while free:
            alike = [one for one in free if one is free[0] or _alike(free[0], one)]
            free = [one for one in free if one not in alike]
            if len(alike) > 1:
                found.append(_joined(alike))
                taken.update(one.names[0] for one in alike)
    found += [one for one in waiting if one.names[0] not in taken]
    return tuple(sorted(found, key=lambda one: one.names))


def pattern_of(names: tuple[str, ...]) -> str:
    """Return the pattern that matches exactly these names, which differ in one segment."""
    if len(names) == 1:
        return escaped(names[0])
    columns = list(zip(*(name.split("/") for name in names), strict=True))
    parts = []
    for column in columns:
        distinct = sorted(set(column))
        if len(distinct) == 1:
            parts.append(escaped(distinct[0]))
        else:
            parts.append("{" + ",".join(escaped(one) for one in distinct) + "}")
    return "/".join(parts)


def escaped(name: str) -> str:
    """Return a name as a pattern that matches only it."""
    return "".join(f"\\{one}" if one in "*?{},\\" else one for one in name)


def _alike(one: Drafted, other: Drafted) -> bool:
    return one.window == other.window and _near(one.lines[0].typical, other.lines[0].typical)


def _near(one: float, other: float) -> bool:
    low, high = sorted((one, other))
    return high <= low * ALIKE


def _joined(members: list[Drafted]) -> Drafted:
    lines = tuple(_widest(lines) for lines in zip(*(one.lines for one in members), strict=True))
    names = tuple(sorted(one.names[0] for one in members))
    seconds = max(one.seconds for one in members)
    messages = sum(one.messages for one in members)
    return Drafted(names, members[0].type, messages, seconds, lines, members[0].window)


def _widest(lines: tuple[Line, ...]) -> Line:
    lows = [line.range.minimum for line in lines]
    highs = [line.range.maximum for line in lines]
    least = None if None in lows else min(low for low in lows if low is not None)
    greatest = None if None in highs else max(high for high in highs if high is not None)
    return Line(
        lines[0].quantity,
        Range(least, greatest),
        sorted(line.typical for line in lines)[len(lines) // 2],
        sum(line.outside for line in lines),
        sum(line.hours for line in lines),
    )
