"""The last run of ``roslens check --changed``, kept apart from whole runs: pages and the terminal show the same."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.store.narrowed import NarrowedView
    from roslens.store.read import RunView
    from roslens.store.runs import Store

STORE = "changed.sqlite"
_FILE = "changed_run.json"
_MOST_BYTES = 64 << 20


class KeptChangedRun(msgspec.Struct, frozen=True):
    """A ``run`` of the packages that differ from a ``revision``; ``paths`` are the files that do, ``others`` do not."""

    run: int
    revision: str
    paths: tuple[str, ...]
    others: tuple[str, ...]


def narrowed_to(view: RunView, paths: Collection[str], others: Collection[str]) -> NarrowedView:
    """Return a run of which only findings and failures in some files count.

    Args:
        view: the run.
        paths: files whose findings stay.
        others: files whose failures are left out; failures of no file stay.
    """
    from roslens.store.narrowed import NarrowedView

    stay, leave = frozenset(paths), frozenset(others)
    return NarrowedView(
        view,
        lambda finding: finding.path in stay,
        keep_failure=lambda failure: failure.location is None or failure.location.path not in leave,
    )


def keep_changed_run(folder: Path, store: Store, kept: KeptChangedRun) -> None:
    """Keep what a run was about, and no run but this; a folder that cannot be written keeps nothing.

    Args:
        folder: ``.roslens`` of the workspace.
        store: with the run.
        kept: what to keep.
    """
    place = folder / _FILE
    with suppress(OSError):
        beside = place.with_suffix(f".{os.getpid()}")
        beside.write_bytes(msgspec.json.encode(kept))
        beside.replace(place)
        store.prune(1)


@contextmanager
def changed_run(start: str) -> Iterator[NarrowedView]:
    """Yield the last run of ``roslens check --changed`` in the workspace that ``start`` is in.

    Raises:
        UsageError: there is none.
        StoreError: the store cannot be read.
    """
    from roslens.cli.workplace.own_store import open_own
    from roslens.cli.workplace.workplace import FOLDER, kept_in, refuse_missing

    refuse_missing(start)
    path = Path(start).resolve()
    folders = (kept_in(above) for above in (path, *path.parents))
    folder = next((one for one in folders if (one / STORE).is_file()), None)
    kept = None if folder is None else _read(folder)
    if folder is not None and kept is not None:
        with open_own(folder / STORE) as store:
            yield narrowed_to(store.view(kept.run), kept.paths, kept.others)
        return
    raise UsageError(
        f"no run of changed files in {str(path)!r} or a folder above it",
        expected=f"a file {FOLDER}/{STORE} that `roslens check --changed` makes",
        advice=f"Run `roslens check --changed {start}` first",
    )


def _read(folder: Path) -> KeptChangedRun | None:
    try:
        return msgspec.json.decode(read_bounded(folder / _FILE, _MOST_BYTES), type=KeptChangedRun)
    except (OSError, ValueError):
        return None
