"""Nodes of a test that end before it does: said at once, with their reason, and not waited for until a time limit."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable
from pathlib import Path

LINES = 3
"""How many of the last lines that a node wrote are shown."""


def ended_early(nodes: Iterable[tuple[subprocess.Popen, Path]]) -> str:
    """Return what nodes wrote that ended with a failure; empty while none did.

    A node that a test ends does so with 0 or by a signal, whose code is negative.

    Args:
        nodes: processes, each with the file that it writes its errors to.
    """
    reported = []
    for process, errors in nodes:
        if (process.poll() or 0) > 0:
            lines = errors.read_text(errors="replace").strip().splitlines() or ["it wrote nothing"]
            reported.append(f"a node ended with {process.returncode}: " + " / ".join(lines[-LINES:]))
    return "; ".join(reported)
