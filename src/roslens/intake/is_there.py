"""Whether something is there under a name that a stranger wrote: no name is too long, too odd or too deep to ask.

``Path.is_file`` and its like raise OSError for a name with a part of more than 255 bytes.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path


def is_file(path: Path | str) -> bool:
    """Return whether a path leads to a plain file; it does not where that cannot be known."""
    return stat.S_ISREG(_mode(path))


def is_folder(path: Path | str) -> bool:
    """Return whether a path leads to a folder; it does not where that cannot be known."""
    return stat.S_ISDIR(_mode(path))


def _mode(path: Path | str) -> int:
    try:
        return os.stat(path).st_mode  # noqa: PTH116 - paths of walks are texts
    except (OSError, ValueError):
        return 0
