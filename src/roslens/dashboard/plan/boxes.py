"""The boxes of hosts and namespaces around what stands in them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from roslens.dashboard.plan.ground import HEAD, PAD, Box, Ground, Reach, parts_of


def boxes_of(ground: Ground) -> tuple[Box, ...]:
    """Return a box around each host and namespace but the global one, outer ones first.

    What came later may have found no room in the box of its namespace: it has a second one of the same name.
    """
    columns: dict[str, list[int]] = {}
    for stand in ground.stands.values():
        columns.setdefault(stand.lane, []).append(stand.column)
    reaches = [reach for reach in ground.reaches if reach.lane in columns]
    deepest = max((len(parts_of(reach.lane)) for reach in reaches), default=0)
    found = []
    for name, group in _runs(reaches):
        used = [column for reach in group for column in columns[reach.lane]]
        depth = len(parts_of(name)) - 1
        # What stands inside of others is that much narrower, so that no two sides fall together.
        side = PAD * (deepest - depth) / deepest
        left, right = ground.spans[min(used)][0] - side, ground.spans[max(used)][1] + side
        first, last = group[0], group[-1]
        top = first.top - HEAD * (len(parts_of(first.lane)) - depth)
        bottom = last.bottom + PAD / 2 * (len(parts_of(last.lane)) - depth)
        size = (round(left, 1), round(top, 1), round(right - left, 1), round(bottom - top, 1))
        found.append(Box(name, *size, depth, title_of(name)))
    return tuple(sorted(found, key=lambda box: (box.depth, box.name, box.y)))


def title_of(name: str) -> str:
    """Return what stands at the top of a box: a host, an outer namespace in full, or the end of an inner one."""
    parts = parts_of(name)
    if parts[-1].startswith("@"):
        return f"host {parts[-1][1:]}"
    outer = len(parts) == 1 or (len(parts) == 2 and parts[0].startswith("@"))
    return f"/{parts[-1]}" if outer else parts[-1]


def _runs(reaches: Iterable[Reach]) -> list[tuple[str, Sequence[Reach]]]:
    """Return for each box the reaches in it, from top to bottom: those below each other that begin with its name."""
    ordered = sorted(reaches, key=lambda reach: reach.top)
    open_: dict[str, list[Reach]] = {}
    found: list[tuple[str, Sequence[Reach]]] = []
    for reach in ordered:
        parts = parts_of(reach.lane)
        names = {"/" + "/".join(parts[: depth + 1]) for depth in range(len(parts))}
        ended = [name for name in open_ if name not in names]
        found += [(name, open_.pop(name)) for name in ended]
        for name in sorted(names):
            open_.setdefault(name, []).append(reach)
    return [*found, *open_.items()]
