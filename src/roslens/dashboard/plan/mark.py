"""How a node or what joins nodes is drawn: its name as it stands in its box, and the size of that."""

from __future__ import annotations

from collections.abc import Collection

from roslens.dashboard.plan.ground import Part

CHARACTER = 6.7
NODE_HEIGHT = 26.0
MARK_HEIGHT = 18.0
MARK = 20.0
"""Room that the mark of a topic, service or action takes before its name."""

LONGEST = 32


def part_of(key: str, name: str, lane: str, program: str = "", *, host: str = "", quiet: bool = False) -> Part:
    """Return the part of a plan for a node, topic, service or action; the key begins with what it is.

    Args:
        key: names it.
        name: as it is shown.
        lane: the namespace in whose box it stands.
        program: of a node of whose own name nothing is known, what it runs.
        quiet: whether it does not affect the placement of nodes.
        host: in whose box that namespace stands; empty where hosts are not distinguished.
    """
    width = len(label_of(name, lane, program)) * CHARACTER
    lane = f"/@{host}{lane.rstrip('/')}" if host else lane
    if key.startswith("node:"):
        return Part(key, round(max(48.0, width + 24), 1), NODE_HEIGHT, lane, quiet=quiet)
    return Part(key, round(MARK + width + 4, 1), MARK_HEIGHT, lane, node=False, quiet=quiet)


def label_of(name: str, lane: str, program: str = "") -> str:
    """Return the name as it stands in the box of its namespace; of a long one the middle is left out."""
    label = relative(name, lane)
    if program:
        label = f"{label} ({program})"
    if len(label) <= LONGEST:
        return label
    return label[:12] + "\N{HORIZONTAL ELLIPSIS}" + label[13 - LONGEST :]


def namespace_of(name: str) -> str:
    """Return the namespace of a resolved name: ``/a/b`` is in ``/a``, ``/a`` in ``/``."""
    return name.rpartition("/")[0] or "/"


def lane_of(name: str, lanes: Collection[str]) -> str:
    """Return the innermost namespace of a name that is one of ``lanes``, which hold nodes; the global one at last."""
    lane = namespace_of(name)
    while lane != "/" and lane not in lanes:
        lane = namespace_of(lane)
    return lane


def relative(name: str, lane: str) -> str:
    """Return the name as seen from its namespace's box."""
    return name.removeprefix(lane if lane == "/" else lane + "/")
