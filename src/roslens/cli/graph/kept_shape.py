"""What of a workspace tells whether what was kept of an earlier look still holds."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.source.rules.graph.private_data import Mention
from roslens.source.run_inputs import Seen


def changes_names(path: str, words: frozenset[bytes], names: Iterable[Mention]) -> bool:
    """Whether another name than before, or one less, stands in a file that other files do not have for sure."""
    for one in names:
        holds = path not in one.own and one.name.encode() in words
        if (holds and not one.found_in) or (not holds and one.found_in == path):
            return True
    return False


def shape_of(seen: Seen) -> object:
    """Return what is known of a workspace without the content of its files."""
    workspace, inventory = seen.workspace, seen.inventory
    languages = [
        (file.path, file.language.value, file.role.value) for files in inventory.files.values() for file in files
    ]
    known = {path for path, _, _ in languages}
    others = [
        (file.path, file.size, file.mtime_ns)
        for found in workspace.packages
        for file in found.files
        if file.path not in known
    ]
    packages = [found.package for found in workspace.packages]
    return [packages, workspace.hidden, workspace.failures, inventory.failures, languages, others]
