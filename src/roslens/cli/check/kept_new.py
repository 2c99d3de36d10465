"""The new findings since a baseline to correct first, stored so that pages show the same as the terminal."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.result import RuleCount

if TYPE_CHECKING:
    from roslens.store.read import RunView

_FILE = "new_since_baseline.json"
_MOST_BYTES = 1 << 20


class KeptNew(msgspec.Struct, frozen=True):
    """The ``first`` to mend of what is new in a ``run`` since a ``baseline``, by its name."""

    run: int
    baseline: str
    first: tuple[RuleCount, ...]


def keep_new(folder: Path, run: int, baseline: str, first: Sequence[RuleCount] | None) -> None:
    """Keep in the ``.roslens`` folder what is new in a run; where it was compared with nothing, what was kept is gone.

    A folder that cannot be written keeps nothing: the run itself stands.
    """
    place, text = folder / _FILE, b""
    if first is not None:
        text = msgspec.json.encode(KeptNew(run, baseline, tuple(first)))
    with suppress(OSError):
        if not text:
            place.unlink(missing_ok=True)
            return
        beside = place.with_suffix(f".{os.getpid()}")
        beside.write_bytes(text)
        beside.replace(place)


def kept_new(folder: Path, run: int) -> tuple[RuleCount, ...]:
    """Return what was stored for a run; nothing if its last check had no baseline, or the file was changed."""
    try:
        kept = msgspec.json.decode(read_bounded(folder / _FILE, _MOST_BYTES), type=KeptNew)
    except (OSError, ValueError):
        return ()
    return kept.first if kept.run == run else ()


def shown_new(options: argparse.Namespace, view: RunView) -> tuple[RuleCount, ...]:
    """Return what is new in the run that pages show, as its last check reported; nothing of a run that is not kept."""
    from roslens.cli.workplace.workplace import some_folder

    folder = None if options.no_store or options.changed else some_folder(options.path)
    return () if folder is None else kept_new(folder, view.id)
