"""How long a computation graph takes to be laid out, beside Graphviz where it is installed.

Usage: plan_speed.py [elements…]. Both lay out the same made-up graph, two nodes for three topics, one after the other:
the ratio tells more than the seconds, which are of a processor. Graphviz has columns from left to right and lines that
bend around boxes, as the pages have.
"""

from __future__ import annotations

import random
import resource
import shutil
import subprocess
import sys
import time

from roslens.dashboard.plan.ground import Part, Wire
from roslens.dashboard.plan.plan import ground_of, plan

TRIES = 3
LONGEST_S = 60
"""What Graphviz has not laid out by then it is not asked to lay out in larger."""


def made_up(count: int) -> tuple[list[Part], list[Wire]]:
    """Return a graph; most of what a topic joins is near, a tenth anywhere."""
    chance = random.Random(3)
    nodes = count * 2 // 5
    parts = [Part(f"{'node' if n < nodes else 'topic'}:/{n}", 100, 26, node=n < nodes) for n in range(count)]
    wires = set()
    for topic in range(nodes, count):
        home = chance.randrange(nodes)
        wires.add((parts[home].key, parts[topic].key))
        for _ in range(chance.choice((1, 1, 2, 3))):
            near = max(0, min(nodes - 1, home + chance.randrange(-20, 60)))
            other = chance.randrange(nodes) if chance.random() < 0.1 else near
            wires.add((parts[topic].key, parts[other].key))
    return parts, sorted(wires)


def own_s(parts: list[Part], wires: list[Wire]) -> float:
    """Return the least of some tries."""
    found = []
    for _ in range(TRIES):
        begun = time.process_time()
        plan(ground_of(parts, wires), parts, wires)
        found.append(time.process_time() - begun)
    return min(found)


def dot_s(parts: list[Part], wires: list[Wire]) -> float | None:
    """Return what Graphviz takes; None where it is not installed or has not ended in time."""
    if not shutil.which("dot"):
        return None
    text = ["digraph {rankdir=LR;node [shape=box,fixedsize=true,width=1.4,height=0.36];"]
    text += [f'"{part.key}";' for part in parts]
    text += [f'"{start}" -> "{end}";' for start, end in wires]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        subprocess.run(
            ["dot", "-Tplain", "-o", "/dev/null"], input="\n".join((*text, "}")), text=True, check=True,
            timeout=LONGEST_S, capture_output=True,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """Print a row for each size."""
    print("elements  wires  roslens s  dot s  times")
    asked = True
    for count in [int(word) for word in sys.argv[1:]] or [100, 200, 500, 1000, 4000]:
        parts, wires = made_up(count)
        own = own_s(parts, wires)
        dot = dot_s(parts, wires) if asked else None
        asked = dot is not None
        reported = f"{dot:8.2f} {dot / own:6.0f}" if dot is not None else f"  none, or not within {LONGEST_S} s"
        print(f"{count:8} {len(wires):6} {own:9.3f} {reported}", flush=True)


if __name__ == "__main__":
    main()
