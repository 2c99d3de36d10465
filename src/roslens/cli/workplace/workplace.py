"""Where roslens keeps what it knows of a workspace: ``.roslens`` in its root."""

from __future__ import annotations

import argparse
import contextlib
import difflib
import os
import sys
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.workplace.own_results import mark_own, note_version, why_foreign
from roslens.cli.workplace.shared_store import SHARED, shared_address
from roslens.intake.user_folder import state_folder
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
        UsageError: there is no such folder, or nothing was checked there yet.
    """
    refuse_missing(start)
    if (folder := some_folder(start)) is not None:
        return folder
    path = Path(start).resolve()
    raise UsageError(
        f"no finished run in {str(path)!r} or a folder above it",
        expected=f"a folder {FOLDER} that `roslens check` makes",
        advice=f"Run `roslens check {start}` first",
    )


def refuse_missing(start: str) -> None:
    """Refuse a workspace that does not exist: the run of a folder above it is not what was asked for.

    Raises:
        UsageError: there is no such file or folder.
    """
    path = Path(start)
    if path.exists():
        return
    beside = [one.name for one in path.parent.iterdir()] if path.parent.is_dir() else []
    near = difflib.get_close_matches(path.name, beside, 1)
    raise UsageError(
        f"there is no folder {start!r}",
        expected="the folder of a workspace that was checked",
        advice=f"Did you mean {str(path.parent / near[0])!r}?" if near else "",
    )


def some_folder(start: str) -> Path | None:
    """Return the folder of this user with a store of the workspace that ``start`` is in; None where there is none."""
    path = Path(start).resolve()
    folders = (kept_in(above) for above in (path, *path.parents))
    return next((one for one in folders if (one / STORE).is_file() or (one / SHARED).is_file()), None)


def kept_in(root: Path) -> Path:
    """Return where results of a workspace are kept: its ``.roslens``, or a folder of this user where that is foreign.

    What is in a foreign one is neither used nor changed, and a line says so once.
    """
    folder = root / FOLDER
    reason = why_foreign(folder, os.environ)
    if not reason:
        return folder
    aside = aside_of(root)
    if str(folder) not in _TOLD:
        _TOLD.add(str(folder))
        print(
            f"roslens: {str(folder)!r} {reason}: it is set aside, and results are kept in {str(aside)!r} "
            f"(`roslens clean --all {root}` removes both)",
            file=sys.stderr,
        )
    return aside


def aside_of(root: Path) -> Path:
    """Return where results of a workspace are kept whose ``.roslens`` is foreign."""
    name = sha256(os.fsencode(root.resolve())).hexdigest()[:16]
    return state_folder(os.environ) / "workspaces" / name


_TOLD: set[str] = set()
"""Foreign folders of which the line was printed."""


def own_folder(root: Path) -> Path:
    """Return where results of a workspace are kept, made and marked as this user's where there is none."""
    note_version(os.environ)
    folder = kept_in(root)
    with contextlib.suppress(OSError):  # a folder that cannot be written is reported when something is to be written
        prepare_folder(folder)
        mark_own(folder, os.environ)
    return folder


def open_store(start: str) -> Store:
    """Open the store of the workspace that ``start`` is in.

    Raises:
        UsageError: there is no such folder, or nothing was checked there yet.
        StoreError: the store cannot be read.
    """
    from roslens.cli.workplace.own_store import open_own
    from roslens.store.runs import Store

    refuse_missing(start)
    if address := shared_address(start):
        return Store.open_shared(address)
    return open_own(find_folder(start) / STORE)
