"""A real watch that ends as soon as it reported what a test waits for, since a test about time never sleeps."""

import json
import signal
import subprocess
import sys
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

ROSLENS = [sys.executable, "-m", "roslens.cli.main"]
PLENTY_S = 60.0
"""After this long the watch ends by itself, whatever it reported."""

Line = dict[str, Any]


class Watched(NamedTuple):
    """What a watch reported, its errors as text, and its exit code."""

    lines: list[Line]
    errors: str
    code: int


def watch_until(
    seen: Callable[[list[Line]], bool], words: list[str], environment: Mapping[str, str], most_s: float = PLENTY_S
) -> Watched:
    """Run ``roslens watch`` with ``words`` until ``seen`` holds of the lines of JSON so far."""
    command = [*ROSLENS, "watch", "--for", f"{most_s:g}s", "--format", "json", *words]
    lines: list[Line] = []
    ended = False
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(command, env=environment, **pipes) as watch:
        for line in watch.stdout:
            if not line.startswith("{"):
                continue
            lines.append(json.loads(line))
            if not ended and seen(lines):
                ended = True
                watch.send_signal(signal.SIGINT)
        errors = watch.stderr.read()
    return Watched(lines, errors, watch.returncode)


def states(lines: list[Line], part: str = "") -> dict[str, str]:
    """Return the last state of each quantity of entities whose address has ``part`` in it."""
    return {one["quantity"]: one["state"] for one in lines if one["is"] == "verdict" and part in one["entity"]}
