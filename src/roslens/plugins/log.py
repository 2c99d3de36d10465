"""The file that takes tracebacks and what plug-ins print."""

from __future__ import annotations

import contextlib
from pathlib import Path


def write_log(log: Path | None, title: str, text: str) -> None:
    """Add a text below a title in brackets; a log that cannot be written stops nothing."""
    if log is None:
        return
    with contextlib.suppress(OSError):
        log.parent.mkdir(parents=True, exist_ok=True)
        with log.open("a", encoding="utf-8", errors="backslashreplace") as stream:
            stream.write(f"[{title}]\n{text.rstrip()}\n")
