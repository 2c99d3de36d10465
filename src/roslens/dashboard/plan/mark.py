"""How a node or what joins nodes is drawn: its name as it stands in its box, and the size of that."""

from __future__ import annotations

from roslens.dashboard.plan.ground import Part

CHARACTER = 6.7
NODE_HEIGHT = 26.0
MARK_HEIGHT = 18.0
MARK = 20.0
"""Room that the mark of a topic, service or action takes before its name."""

LONGEST = 32


def part_of(key: str, name: str, lane: str, program: str = "", *, host: str = "") -> Part:
    """Return the part of a plan for a node, topic, service or action; the key begins with what it is.

    Args:
        key: names it.
        name: as it is shown.
        lane: the namespace in whose box it stands.
        program: of a node of whose own name nothing is known, what it runs.
        host: in whose box that namespace stands; empty where hosts are not told apart.
    """
    width = len(label_of(name, lane, program)) * CHARACTER
    lane = f"/@{host}{lane.rstrip('/')}" if host else lane
    if key.startswith("node:"):
        return Part(key, round(max(48.0, width + 24), 1), NODE_HEIGHT, lane)
    return Part(key, round(MARK + width + 4, 1), MARK_HEIGHT, lane, node=False)


def label_of(name: str, lane: str, program: str = "") -> str:
    """Return the name as it stands in the box of its namespace; of a long one the middle is left out."""
    label = relative(name, lane)
    if program:
        label = f"{label} ({program})"
    if len(label) <= LONGEST:
        return label
    return label[:12] + "\N{HORIZONTAL ELLIPSIS}" + label[13 - LONGEST :]


def relative(name: str, lane: str) -> str:
    """Return the name as seen from its namespace's box."""
    return name.removeprefix(lane if lane == "/" else lane + "/")
