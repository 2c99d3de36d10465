"""How often the files of findings changed lately, kept beside the store: git is asked once for each run."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.intake.bounded_file import read_bounded

if TYPE_CHECKING:
    from roslens.store.read import RunView

_FILE = "recent_changes.json"
_MOST_BYTES = 1 << 20


class KeptChanges(msgspec.Struct, frozen=True):
    """The commits of the last year by file, of the files that are examples of findings of a ``run``."""

    run: int
    commits: dict[str, int]


def changes_of(view: RunView, folder: Path | None) -> Mapping[str, int]:
    """Return in how many commits of the last year the files of a run's worst findings changed.

    Args:
        view: of the run.
        folder: ``.roslens``, where the answer of git is kept; None keeps nothing.
    """
    if folder is not None and (known := _read(folder, view.id)) is not None:
        return known
    found = _asked(view)
    if folder is not None:
        with suppress(OSError):
            place = folder / _FILE
            beside = place.with_suffix(f".{os.getpid()}")
            beside.write_bytes(msgspec.json.encode(KeptChanges(view.id, found)))
            beside.replace(place)
    return found


def shown_changes(options: argparse.Namespace, view: RunView) -> Mapping[str, int]:
    """Return what was kept of the run that pages show, as its last check has it; nothing of a run that is not kept."""
    from roslens.cli.workplace.workplace import some_folder

    folder = None if options.no_store or options.changed else some_folder(options.path)
    return ({} if folder is None else _read(folder, view.id)) or {}


def _read(folder: Path, run: int) -> dict[str, int] | None:
    try:
        kept = msgspec.json.decode(read_bounded(folder / _FILE, _MOST_BYTES), type=KeptChanges)
    except (OSError, ValueError):
        return None
    return kept.commits if kept.run == run else None


def _asked(view: RunView) -> dict[str, int]:
    from roslens.source.history.recent_changes import recent_changes

    wanted = set(_paths(view))
    found: dict[str, int] = {}
    if wanted:
        for place, _ in view.header.commits:
            before = "" if place == "." else f"{place}/"
            counts = recent_changes(str(Path(view.header.root, place)))
            found |= {path: counts[below] for path in wanted if (below := path.removeprefix(before)) in counts}
    return dict(sorted(found.items()))


def _paths(view: RunView) -> Iterator[str]:
    for package in view.packages():
        yield from (rule.path for rule in package.rules if rule.gated and rule.path)
    yield from (finding.path for finding in view.workspace.findings if finding.gated and finding.path)
