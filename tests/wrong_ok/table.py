"""Runs every case of the gate, and prints the table of docs/faults.md.

PYTHONPATH=tests .venv/bin/python -m wrong_ok.table [REPEATS] [CASE...]
"""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path

from testbed import robot_ros1, robot_ros2
from wrong_ok.cases import CASES, OF_ROS1
from wrong_ok.scene import Scene

HEAD = """\
| what is wrong | times | as it should be | mistakes | s each | load |
| --- | --- | --- | --- | --- | --- |"""


def line(name: str, repeats: int) -> tuple[str, bool]:
    """Run a case so many times; return its row in Markdown, and whether all was right."""
    found: list[list[str]] = []
    loads = []
    began = time.monotonic()
    for _ in range(repeats):
        with tempfile.TemporaryDirectory(prefix="roslens-gate-", ignore_cleanup_errors=True) as folder:
            scene = Scene(Path(folder), robot_ros2.python())
            try:
                found.append(CASES[name](scene))
            finally:
                scene.close()
        loads.append(os.getloadavg()[0])
    right = sum(not one for one in found)
    mistakes = sorted({mistake for one in found for mistake in one})
    seconds = (time.monotonic() - began) / repeats
    cells = [
        name,
        str(repeats),
        str(right),
        "; ".join(mistakes),
        f"{seconds:.0f}",
        f"{min(loads):.0f} to {max(loads):.0f}",
    ]
    return "| " + " | ".join(cells) + " |", right == repeats


def main(words: list[str]) -> int:
    """Return 1 where anything was not as it should be."""
    repeats = int(words.pop(0)) if words and words[0].isdecimal() else 20
    if reason := robot_ros2.why_not():
        sys.stderr.write(f"{reason}\n")
        return 1
    sys.stdout.write(HEAD + "\n")
    wrong = False
    for name in CASES:
        if words and not any(word in name for word in words):
            continue
        if name in OF_ROS1 and (reason := robot_ros1.why_not()):
            sys.stderr.write(f"{name}: {reason}\n")
            wrong = True
            continue
        row, right = line(name, repeats)
        wrong |= not right
        sys.stdout.write(row + "\n")
        sys.stdout.flush()
    return int(wrong)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
