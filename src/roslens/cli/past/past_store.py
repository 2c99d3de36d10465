"""Where the runs of past revisions are kept: beside those of today, in a file or in a database that machines share."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.workplace.shared_store import SHARED, VARIABLE, note_shared, shared_address
from roslens.cli.workplace.workplace import STORE, kept_in, own_folder

if TYPE_CHECKING:
    from roslens.store.runs import Store

PAST = "history.sqlite"
"""The store of the runs of past revisions, in the folder of the workspace."""

BESIDE = "_history"
"""What the schema of past revisions is called behind that of today's runs."""


class KeptPast(msgspec.Struct, frozen=True):
    """Past revisions that were analysed.

    Attributes:
        root: of their workspace.
        address: of the database that has them; empty for a file.
    """

    root: Path
    address: str = ""

    def open(self) -> Store:
        """Open their runs to be read.

        Raises:
            StoreError: they cannot be read.
        """
        from roslens.cli.workplace.own_store import open_own
        from roslens.store.runs import Store

        return Store.open_shared(self.address) if self.address else open_own(kept_in(self.root) / PAST)


def kept_past(start: str) -> KeptPast | None:
    """Return where the past revisions of the workspace that ``start`` is in are kept; None where there are none.

    Raises:
        RoslensError: the database that should have them does not let in.
    """
    path = Path(start).resolve()
    if address := _beside(shared_address(start)):
        from roslens.store.postgres.connection import has_schema

        return KeptPast(workspace_root(start), address) if has_schema(address) else None
    root = next((above for above in (path, *path.parents) if (kept_in(above) / PAST).is_file()), None)
    return None if root is None else KeptPast(root)


def open_past(root: Path) -> Store:
    """Open the store that runs of past revisions of a workspace are added to; made where there is none.

    Raises:
        RoslensError: it cannot be opened, or existing files may be of someone else.
    """
    from roslens.cli.workplace.own_store import open_own
    from roslens.store.runs import Store

    folder = own_folder(root)
    address = _beside(shared_address(str(root)))
    if not address:
        _tell_untrusted(root)
        return open_own(folder / PAST)
    store = Store.open_shared(address)
    note_shared(folder, shared_address(str(root)))
    return store


def workspace_root(start: str) -> Path:
    """Return the folder of the workspace that ``start`` is in: where runs are kept, else ``start`` itself."""
    path = Path(start).resolve()
    kept = (
        above
        for above in (path, *path.parents)
        if any((folder / name).is_file() for folder in [kept_in(above)] for name in (STORE, PAST, SHARED))
    )
    return next(kept, path)


def _beside(address: str) -> str:
    if not address:
        return ""
    from roslens.store.postgres.connection import with_schema

    return with_schema(address, BESIDE)


def _tell_untrusted(root: Path, environment: Mapping[str, str] = os.environ) -> None:
    from roslens.cli.workplace.configuration import find_configuration

    configuration = find_configuration(root, None)
    if configuration.store and not environment.get(VARIABLE):
        said = f"store = {configuration.store} of {configuration.path} is not used until `roslens trust`"
        print(f"roslens: {said}", file=sys.stderr)
