"""To which package each finding belongs that was made by looking at all of them together."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

from roslens.model.finding import Finding
from roslens.model.source import Package, SourceFile


def owned_findings(
    findings: Iterable[Finding], packages: Iterable[Package], files: Mapping[str, tuple[SourceFile, ...]]
) -> tuple[dict[str, tuple[Finding, ...]], tuple[Finding, ...]]:
    """Return the findings of each package by its id, sorted, and those that belong to none.

    A finding belongs to the package that holds its file, else to the one whose folder holds its path, else to the
    package that it is about.

    Args:
        findings: each with its path below the root of the workspace.
        packages: all of the run.
        files: that were looked at, by the id of their package.
    """
    holder = {file.path: package for package, held in files.items() for file in held}
    folders = {package.path.strip("/"): package.id for package in packages if package.id in files}
    owned: dict[str, list[Finding]] = defaultdict(list)
    for finding in findings:
        kind, _, name = finding.entity.partition(":")
        about = name if kind == "package" and name in files else ""
        owned[holder.get(finding.path) or _within(finding.path, folders) or about].append(finding)
    none = tuple(owned.pop("", ()))
    return {package: tuple(owned[package]) for package in sorted(owned)}, none


def _within(path: str, folders: Mapping[str, str]) -> str:
    """Return the package whose folder is the innermost around a path; empty where there is none."""
    while path:
        path = path.rpartition("/")[0]
        if found := folders.get(path or "."):
            return found
    return ""
