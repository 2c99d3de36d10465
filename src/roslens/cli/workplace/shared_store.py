"""Where runs are kept: a file below the workspace, or a database that several machines share."""

from __future__ import annotations

import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.workplace.configuration import Configuration
    from roslens.store.runs import Store

VARIABLE = "ROSLENS_STORE"
"""Names a database in place of the configuration."""
SHARED = "store.shared"
"""Stands where the runs of a workspace are in a database: a note for people of which."""


def store_for(kept: Path | None, configuration: Configuration, environment: Mapping[str, str] = os.environ) -> Store:
    """Open the store of a run that is made now.

    Args:
        kept: the file; None where nothing is to be kept.
        configuration: with only the servers that the user trusts.
        environment: of this process.

    Raises:
        UsageError: the address is none, or psycopg is not installed.
        StoreError: the store cannot be opened.
    """
    from roslens.cli.workplace.own_store import open_own
    from roslens.store.runs import Store

    address = environment.get(VARIABLE) or configuration.store
    if kept is None:
        return Store.open(None)
    if not address:
        return open_own(kept)
    store = Store.open_shared(_checked(address))
    note_shared(kept.parent, address)
    return store


def note_shared(folder: Path, address: str) -> None:
    """Leave a note for people of the database that has the runs of a workspace, where they would look for them."""
    from roslens.store.postgres.connection import shown

    with suppress(OSError):
        (folder / SHARED).write_text(f"{shown(address)}\n", "utf-8")


def shared_address(start: str, environment: Mapping[str, str] = os.environ) -> str:
    """Return the database that has the runs of the workspace that ``start`` is in; empty for none.

    Raises:
        UsageError: the address is none, or what the user trusts cannot be read.
        DocumentError: the configuration is wrong.
    """
    if address := environment.get(VARIABLE):
        return _checked(address)
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.cli.workplace.trust import is_trusted

    path = Path(start).resolve()
    configuration = find_configuration(path, None) if path.exists() else None
    if configuration is None or not configuration.store or not is_trusted(configuration, environment):
        return ""
    return _checked(configuration.store)


def _checked(address: str) -> str:
    if not address.startswith(("postgresql://", "postgres://")):
        raise UsageError(f"the store {address!r}", expected="postgresql://HOST/DATABASE")
    return address
