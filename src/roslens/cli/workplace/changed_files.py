"""Which files of a workspace are not what a stored run saw."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.intake.bounded_file import read_bounded

if TYPE_CHECKING:
    from roslens.store.read import RunView


def changed_files(view: RunView, now: Collection[str] | None = None) -> tuple[str, ...]:
    """Return the paths of files that changed, vanished or came since a run, sorted.

    Args:
        view: the run.
        now: all files that there are; of new ones only those count whose name tells a language. None looks for none.
    """
    from roslens.model.source import Language
    from roslens.source.keys import content_hash
    from roslens.source.workspace.languages import language_by_name

    root = Path(view.header.root)
    seen = {file.path: file.content_hash for _, file in view.files()}
    # A run knows of files that are in some language.
    found = {path for path in now or () if path not in seen and language_by_name(path) not in {None, Language.OTHER}}
    for path, hash_ in seen.items():
        try:
            same = not hash_ or content_hash(read_bounded(root / path)) == hash_
        except OSError:
            same = False
        if not same:
            found.add(path)
    return tuple(sorted(found))


def and_more(paths: Collection[str]) -> str:
    """Return the first path and how many there are besides."""
    first, *more = paths
    return f"{first} and {len(more)} more" if more else first
