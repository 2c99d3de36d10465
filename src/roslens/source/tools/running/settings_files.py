"""Settings files of tools in the folders above a source file: their content affects what a tool reports."""

from __future__ import annotations

import os
from pathlib import Path

from roslens.intake.bounded_file import read_bounded
from roslens.source.keys import key_of

MOST_BYTES = 1_000_000


class SettingsFiles:
    """Keys of settings files, each folder looked at once."""

    def __init__(self, root: str) -> None:
        """Paths are below ``root``; folders above it count as well, as they do for the tools."""
        self._root = root
        self._known: dict[tuple[str, tuple[str, ...]], str] = {}

    def key_of(self, path: str, names: tuple[str, ...]) -> str:
        """Return a key of all files of these names in the folder of a file and above; empty where there are none."""
        if not names:
            return ""
        folder = os.path.dirname(os.path.join(self._root, path))  # noqa: PTH118, PTH120 - no Path a file
        return self._of_folder(folder, names)

    def _of_folder(self, folder: str, names: tuple[str, ...]) -> str:
        known = self._known.get((folder, names))
        if known is not None:
            return known
        parent = os.path.dirname(folder)  # noqa: PTH120
        above = self._of_folder(parent, names) if parent != folder else ""
        here = [(name, content) for name in names if (content := _content(Path(folder, name))) is not None]
        key = key_of(above, here) if here else above
        self._known[folder, names] = key
        return key


def _content(path: Path) -> bytes | None:
    try:
        return read_bounded(path, MOST_BYTES)
    except FileNotFoundError:
        return None
    except OSError as error:
        return str(error).encode("utf-8", "replace")
