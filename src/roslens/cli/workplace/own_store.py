"""The stores of this user, opened with the key that they are sealed with."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.workplace.own_results import key_of_store, lies_here_from_before

if TYPE_CHECKING:
    from roslens.store.runs import Store


def open_own(path: Path) -> Store:
    """Open the store at ``path`` in a folder of this user; one that something else changed is set aside.

    Raises:
        StoreError: it cannot be opened.
    """
    from roslens.store.runs import Store
    from roslens.store.sealing.sealing import Sealing

    adopts = lies_here_from_before(path, os.environ)
    try:
        key = key_of_store(path, os.environ)
    except OSError:
        # Nothing can be kept in such a folder, and nothing of this user is in it.
        return Store.open(path)
    return Store.open(path, sealing=Sealing(key, adopts, _say))


def _say(line: str) -> None:
    print(f"roslens: {line}", file=sys.stderr)
