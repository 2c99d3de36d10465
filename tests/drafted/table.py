"""Drafts a reference from a running robot, watches the robot with it, and prints which kinds of faults it reports.

PYTHONPATH=tests .venv/bin/python -m drafted.table [SECONDS] [KIND...]

The robot runs well for as long as was drafted from before the first fault: every alarm then is false.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from wrong_ok.lines import Lines
from wrong_ok.scene import Scene

from drafted.faults import KINDS, Kind, Robot
from testbed import robot_ros2

NODES = Path(__file__).parent / "nodes.py"
BAD = ("low", "high", "absent")
TOLD_S = 25.0
WELL_S = 60.0
HEAD = "| fault | reported | s to alarm | well again |\n| --- | --- | --- | --- |"


class Row(NamedTuple):
    """What came of a fault: what was reported of it, after how many seconds, and whether all was well after it."""

    kind: str
    told: str
    seconds: float
    well: bool


def bad(lines: Lines) -> set[str]:
    """Return what is bad now, as ``entity quantity``."""
    found = {}
    for one in lines.seen:
        if one.get("is") == "verdict":
            found[f"{one['entity']} {one['quantity']}"] = one["state"]
    return {key for key, state in found.items() if state in BAD}


def told(line: dict[str, Any], kind: Kind) -> str:
    """Return what a line reports of a fault; empty where it reports nothing of it."""
    key = f"{line['entity']} {line['quantity']}" if line.get("is") == "verdict" and line["state"] in BAD else ""
    return key if any(part in key for part in kind.about) else ""


def row(robot: Robot, watch: Lines, name: str) -> Row:
    """Put a fault in, wait until it is reported, take it out, and wait until all is well."""
    kind = KINDS[name]
    watch.until(lambda _: False, 0.0)
    first, began = len(watch.seen), time.monotonic()
    with kind.begin(robot):
        found = watch.until(lambda line: told(line, kind), TOLD_S)
        seconds = time.monotonic() - began
    reported = next((text for one in watch.seen[first:] if (text := told(one, kind))), "") if found else ""
    well = not bad(watch) or watch.until(lambda _: not bad(watch), WELL_S)
    return Row(name, reported, seconds, well)


def rows(scene: Scene, seconds: float, names: list[str]) -> Iterator[Row]:
    """Draft, watch the healthy robot for as long, and yield a row for it and for each kind of fault."""
    robot = Robot(scene)
    draft = scene.draft(seconds)
    watch = scene.watch_file(draft)
    watch.until(lambda _: False, seconds)
    false = sorted({f"{one['entity']} {one['quantity']}" for one in watch.seen if one.get("state") in BAD})
    yield Row("none", ", ".join(false), seconds, not bad(watch))
    for name in names:
        yield row(robot, watch, name)


def line(one: Row) -> str:
    """Return a row in Markdown."""
    seconds = f"{one.seconds:.1f}" if one.told and one.kind != "none" else ""
    return f"| {one.kind} | {f'`{one.told}`' if one.told else 'no'} | {seconds} | {'yes' if one.well else 'no'} |"


def main(words: list[str]) -> int:
    """Return 1 where a kind of fault was not reported, or the healthy robot had an alarm."""
    seconds = float(words.pop(0)) if words and words[0].isdecimal() else 60.0
    if reason := robot_ros2.why_not():
        sys.stderr.write(f"{reason}\n")
        return 1
    names = [name for name in KINDS if not words or any(word in name for word in words)]
    wrong = False
    sys.stdout.write(HEAD + "\n")
    with tempfile.TemporaryDirectory(prefix="roslens-draft-", ignore_cleanup_errors=True) as folder:
        scene = Scene(Path(folder), robot_ros2.python(), NODES)
        try:
            for one in rows(scene, seconds, names):
                wrong |= bool(one.told) is (one.kind == "none")
                sys.stdout.write(line(one) + "\n")
                sys.stdout.flush()
            sys.stderr.write((Path(folder) / "draft.yaml").read_text())
        finally:
            scene.close()
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
