"""What a killed process left beside the file or folder that it was writing; the next that writes there removes it."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
from pathlib import Path

PART = "part"
"""Suffix of a file that is being written."""

PARTIAL = "partial"
"""Suffix of a folder that is being written."""

OLD = "old"
"""Suffix of a folder that is being replaced."""


def beside(target: Path, suffix: str) -> Path:
    """Return where this process writes what will take the place of ``target``, or keeps what was there."""
    return target.with_name(f".{target.name}.{os.getpid()}.{suffix}")


def sweep(target: Path) -> None:
    """Remove what processes that are no longer there left beside ``target``.

    Where one was killed between two renames, so that only the old folder is left, that takes its place again. What
    cannot be removed stays.
    """
    pattern = re.compile(rf"\.{re.escape(target.name)}\.(\d+)\.(?:{PART}|{PARTIAL}|{OLD})")
    try:
        names = [name for name in os.listdir(target.parent) if name.startswith(f".{target.name}.")]  # noqa: PTH208 - names suffice
    except OSError:
        return
    for name in sorted(names):
        found = pattern.fullmatch(name)
        if found is None or _is_there(int(found[1])):
            continue
        left = target.with_name(name)
        with contextlib.suppress(OSError):
            if left.is_symlink() or not left.is_dir():
                left.unlink()
            elif name.endswith(f".{OLD}") and not target.exists():
                left.rename(target)
            else:
                shutil.rmtree(left, ignore_errors=True)


def _is_there(process: int) -> bool:
    if process == os.getpid():
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):
        return True
    return True
