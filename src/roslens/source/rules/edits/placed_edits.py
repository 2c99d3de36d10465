"""Edits of hits with what only the place of a file tells: its path, its content's hash, the name of its guard."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

import msgspec

from roslens.model.edit import Edit
from roslens.source.rules.guard_style import guard_name
from roslens.source.rules.hit import GUARD_NAME, Hit
from roslens.source.rules.package_view import PackageView


def with_placed_edits(hits: Iterable[Hit], path: str, view: PackageView, style: str) -> Iterator[Hit]:
    """Yield hits in a file of a package, their edits placed; one of a file that nobody knows loses its edits.

    Args:
        hits: in the file.
        path: of the file, below the workspace.
        view: the package.
        style: of the names of guards, see :func:`~roslens.source.rules.guard_style.guard_style`.
    """
    for hit in hits:
        yield _placed(hit, path, view, lambda one: guard_name(view.inside(one), view.package.name, style))


def _placed(hit: Hit, path: str, view: PackageView, guard: Callable[[str], str]) -> Hit:
    if not hit.edits:
        return hit
    edits: list[Edit] = []
    for edit in hit.edits:
        target = edit.path or path
        file = view.by_path.get(target)
        if file is None or not file.content_hash:
            return msgspec.structs.replace(hit, edits=())
        text = edit.text.replace(GUARD_NAME, guard(target)) if GUARD_NAME in edit.text else edit.text
        edits.append(msgspec.structs.replace(edit, path=target, text=text, made_for=file.content_hash))
    return msgspec.structs.replace(hit, edits=tuple(edits))
