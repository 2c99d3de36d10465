"""Scripts and texts in which a command line that starts a launch file may be written."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from posixpath import dirname

_ENDS = (".sh", ".bash", ".zsh", ".md", ".rst", ".txt", ".desktop", ".service")
_MOST = 200


def command_texts(root: str, package: str, inside: Iterable[str]) -> list[str]:
    """Return the paths below the root of such files of a package, and of those beside it and above.

    Args:
        root: of the workspace.
        package: folder of the package below it, ``.`` or empty for the root itself.
        inside: paths of the files of the package, below the root.
    """
    paths = sorted(path for path in inside if path.endswith(_ENDS))
    folder = "" if package == "." else package
    while folder:
        folder = dirname(folder)
        paths.extend(_in_folder(Path(root), folder))
    return paths[:_MOST]


def _in_folder(root: Path, folder: str) -> list[str]:
    """Return the paths of such files in a folder of the workspace, sorted."""
    try:
        names = sorted(one.name for one in (root / folder).iterdir() if one.name.endswith(_ENDS))
    except OSError:
        return []
    return [f"{folder}/{name}" if folder else name for name in names]
