"""roslens.accepted.toml: read, changed and written whole."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from roslens.cli.workplace.configuration import find_configuration
from roslens.model.errors import UsageError
from roslens.model.finding import Finding
from roslens.model.set_aside import Disposition
from roslens.report.writing.whole_file import whole_file
from roslens.source.workspace.acceptances import FILE_NAME, Acceptance, read_acceptances, to_toml


def accepted_file_of(root: Path, configuration: str | None = None) -> Path:
    """Return where the file of a workspace is, or would be."""
    return Path(find_configuration(root, configuration).base or ".") / FILE_NAME


def entries_of(place: Path) -> tuple[Acceptance, ...]:
    """Return what the file says.

    Raises:
        UsageError: something in it cannot be read, which would be lost when the file is written again.
    """
    entries, failures = read_acceptances(place)
    if failures:
        raise UsageError(f"{place}: {failures[0].what}", expected=failures[0].expected, advice="Fix the file first")
    return entries


def with_findings(
    entries: Iterable[Acceptance], findings: Iterable[Finding], reason: str, state: Disposition
) -> list[Acceptance]:
    """Return entries with those of findings, in place of earlier ones about them."""
    added = {
        one.fingerprint: Acceptance(one.fingerprint, reason, state, one.rule, one.path, one.entity, one.message)
        for one in findings
    }
    return [*(one for one in entries if one.fingerprint not in added), *added.values()]


def write_entries(place: Path, entries: list[Acceptance]) -> None:
    """Write the file, whole or not at all; one without entries goes away."""
    if not entries:
        place.unlink(missing_ok=True)
        return
    with whole_file(place) as stream:
        stream.write(to_toml(entries))
