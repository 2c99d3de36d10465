"""Where roslens keeps what it knows of a workspace: ``.roslens`` in its root."""

from __future__ import annotations

import argparse
import contextlib
import os
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.workplace.own_results import mark_own, refuse_foreign
from roslens.cli.workplace.shared_store import SHARED, shared_address
from roslens.model.errors import UsageError
from roslens.store.folder import prepare_folder

if TYPE_CHECKING:
    from roslens.store.runs import Store

FOLDER = ".roslens"
STORE = "store.sqlite"
CACHE = "cache.sqlite"
ANSWERS = "forges"


def add_workspace_argument(parser: argparse.ArgumentParser) -> None:
    """Add the optional PATH that says which workspace's last run is meant."""
    parser.add_argument(
        "path",
        nargs="?",
        default=".",
        metavar="PATH",
        help="the workspace that was checked (default: this folder)",
    )


def find_folder(start: str) -> Path:
    """Return the ``.roslens`` folder of the workspace that ``start`` is in.

    Raises:
        UsageError: nothing was checked there yet, or it may be of someone else.
    """
    if (folder := some_folder(start)) is not None:
        refuse_foreign(folder, os.environ)
        return folder
    path = Path(start).resolve()
    raise UsageError(
        f"no finished run in {str(path)!r} or a folder above it",
        expected=f"a folder {FOLDER} that `roslens check` makes",
        advice=f"Run `roslens check {start}` first",
    )


def some_folder(start: str) -> Path | None:
    """Return the ``.roslens`` folder with a store that ``start`` is in, whoever made it; None where there is none."""
    path = Path(start).resolve()
    folders = (above / FOLDER for above in (path, *path.parents))
    return next((one for one in folders if (one / STORE).is_file() or (one / SHARED).is_file()), None)


def own_folder(root: Path) -> Path:
    """Return the ``.roslens`` folder of a workspace, made and marked as this user's where there is none.

    Raises:
        UsageError: the existing one may be of someone else.
    """
    folder = root / FOLDER
    refuse_foreign(folder, os.environ)
    with contextlib.suppress(OSError):  # a folder that cannot be written is reported when something is to be written
        prepare_folder(folder)
        mark_own(folder, os.environ)
    return folder


def open_store(start: str) -> Store:
    """Open the store of the workspace that ``start`` is in.

    Raises:
        UsageError: nothing was checked there yet.
        StoreError: the store cannot be read.
    """
    from roslens.store.runs import Store

    if address := shared_address(start):
        return Store.open_shared(address)
    return Store.open(find_folder(start) / STORE)
