"""The folder ``.roslens``: out of version control and out of back-ups, because it can be made again."""

from __future__ import annotations

from pathlib import Path

FOLDER = ".roslens"

_CACHE_TAG = """\
Signature: 8a477f597d28d172789f06886806bc55
# This file marks a folder that can be made again (https://bford.info/cachedir/): roslens keeps its results here.
"""


def prepare_folder(folder: Path) -> None:
    """Make ``folder`` if it is missing; mark it if it is a ``.roslens``.

    A folder of another name belongs to the user and gets nothing but the file that was asked for.

    Raises:
        OSError: the folder cannot be made or written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    if folder.name == FOLDER:
        for name, text in ((".gitignore", "*\n"), ("CACHEDIR.TAG", _CACHE_TAG)):
            if not (folder / name).exists():
                (folder / name).write_text(text, encoding="utf-8")
