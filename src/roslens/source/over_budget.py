"""A file that costs more than a file may, as what is reported of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from roslens.intake.file_budget import refused
from roslens.intake.time_budget import SOURCE_FILE_S, OverBudgetError
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.source import Language, Location, Role, SourceFile

_AS_PROGRAM = " (graph)"


def as_program(path: str) -> str:
    """Return what a file is called while its program is made, of which it may be measured all the same."""
    return f"{path}{_AS_PROGRAM}"


def in_rules(path: str) -> str:
    """Return what a manifest is called while rules look at it, whose facts may be known all the same."""
    return f"{path} (rules)"


def over_budget(file: SourceFile, error: OverBudgetError, *, package: str = "") -> Failure:
    """Return the failure; in code of others, tests and what was generated it leaves out nothing that is judged."""
    return _failure(file.path, str(error), package, partial=file.role is not Role.OWN)


def over_budget_beside(files: Iterable[SourceFile], package: str, known: Sequence[Failure]) -> Iterator[Failure]:
    """Yield the failures of files that were left out, but for those that are known.

    Args:
        files: of a package.
        package: its id.
        known: failures of it.
    """
    if not refused():
        return
    # A manifest that is left out is reported by who finds packages.
    asked = ((file, file.path if file.language is not Language.MANIFEST else in_rules(file.path)) for file in files)
    reported = {one.location.path for one in known if one.location is not None and "is left out" in one.what}
    for file, subject in asked:
        why = refused().get(subject)
        if why and file.path not in reported:
            yield _failure(file.path, why, package, partial=file.role is not Role.OWN)


def over_budget_at(path: str, error: OverBudgetError, package: str = "") -> Failure:
    """Return the failure of a file of which no more is known than its path."""
    return _failure((error.subject or path).removesuffix(_AS_PROGRAM), str(error), package, partial=True)


def _failure(path: str, why: str, package: str, *, partial: bool) -> Failure:
    return Failure(
        tool="syntax",
        what=f"the file is left out: {why}",
        expected=f"source that is understood within {SOURCE_FILE_S:g} s of processor time",
        advice="Split it, or add it to `ignore` below [workspace] in roslens.toml",
        location=Location(path),
        entity=str(EntityId(EntityKind.FILE, path)),
        package=package,
        partial=partial,
    )
