"""A file that costs more than a file may, as what is reported of it."""

from __future__ import annotations

from roslens.intake.time_budget import SOURCE_FILE_S, OverBudgetError
from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.model.source import Location, Role, SourceFile


def over_budget(file: SourceFile, error: OverBudgetError, *, package: str = "") -> Failure:
    """Return the failure; in code of others, tests and what was generated it leaves out nothing that is judged."""
    return Failure(
        tool="syntax",
        what=f"the file is left out: {error}",
        expected=f"source that is understood within {SOURCE_FILE_S:g} s of processor time",
        advice="Split it, or add it to `ignore` below [workspace] in roslens.toml",
        location=Location(file.path),
        entity=str(EntityId(EntityKind.FILE, file.path)),
        package=package,
        partial=file.role is not Role.OWN,
    )
