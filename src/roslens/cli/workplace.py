"""Where roslens keeps what it knows of a workspace: ``.roslens`` in its root."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.store.runs import Store

FOLDER = ".roslens"
STORE = "store.sqlite"
CACHE = "cache.sqlite"


def add_workspace_argument(parser: argparse.ArgumentParser) -> None:
    """Add the optional PATH that says which workspace's last run is meant."""
    parser.add_argument(
        "path", nargs="?", default=".", metavar="PATH", help="the workspace that was checked (default: this folder)"
    )


def find_folder(start: str) -> Path:
    """Return the ``.roslens`` folder of the workspace that ``start`` is in.

    Raises:
        UsageError: nothing was checked there yet.
    """
    path = Path(start).resolve()
    for folder in (path, *path.parents):
        if (folder / FOLDER / STORE).is_file():
            return folder / FOLDER
    raise UsageError(
        f"no finished run in {str(path)!r} or a folder above it",
        expected=f"a folder {FOLDER} that `roslens check` makes",
        advice=f"Run `roslens check {start}` first",
    )


def open_store(start: str) -> Store:
    """Open the store of the workspace that ``start`` is in.

    Raises:
        UsageError: nothing was checked there yet.
        StoreError: the store cannot be read.
    """
    from roslens.store.runs import Store

    return Store.open(find_folder(start) / STORE)
