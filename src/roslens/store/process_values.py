"""One process metric across a run: of files and repositories, which have it beside what they contain."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from roslens.model.entity import EntityId, EntityKind
from roslens.model.process import RepositoryProcess
from roslens.model.source import SourceFile


def file_values(process: Iterable[RepositoryProcess]) -> dict[str, Mapping[str, float]]:
    """Return the values of each file by the text form of its id."""
    return {str(EntityId(EntityKind.FILE, path)): values for one in process for path, values in one.files.items()}


def process_numbers(
    process: Sequence[RepositoryProcess], files: Iterable[tuple[str, SourceFile]], quantity: str, kind: EntityKind
) -> list[tuple[str, str, float]]:
    """Return entity id, package id and value of every file or repository that has the quantity.

    Args:
        process: of the run.
        files: package ids and files of the run; read where files are asked for.
        quantity: a process metric.
        kind: file or repository; other kinds have none here.
    """
    if kind is EntityKind.REPOSITORY:
        found = ((str(EntityId(kind, one.path)), "", one.values.get(quantity)) for one in process)
        return [(identity, package, value) for identity, package, value in found if value is not None]
    if kind is not EntityKind.FILE or not any(quantity in values for one in process for values in one.files.values()):
        return []
    known = file_values(process)
    named = ((str(EntityId(kind, file.path)), package) for package, file in files)
    return [(one, package, known[one][quantity]) for one, package in named if quantity in known.get(one, ())]


def measured_by_history(process: Iterable[RepositoryProcess], kind: EntityKind | None) -> set[str]:
    """Return the quantities that files and repositories have of their history, or one of these kinds."""
    found: set[str] = set()
    for one in process:
        if kind in {None, EntityKind.FILE}:
            found.update(quantity for values in one.files.values() for quantity in values)
        if kind in {None, EntityKind.REPOSITORY}:
            found.update(one.values)
    return found
