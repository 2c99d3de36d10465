"""The packages of a workspace in which a file is not as an earlier state had it, and which of their files matter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath

import msgspec

from roslens.model.source import SourceFile
from roslens.source.workspace.find import Workspace


def with_changes(
    workspace: Workspace, files: Mapping[str, Sequence[SourceFile]], unchanged: Mapping[str, str]
) -> Workspace:
    """Return the workspace with the packages of which a file is new or differs.

    Args:
        workspace: with all packages.
        files: of each package, by its id.
        unchanged: hashes that files had, by path.
    """
    packages = tuple(
        found
        for found in workspace.packages
        if any(unchanged.get(file.path) != file.content_hash for file in files[found.package.id])
    )
    return msgspec.structs.replace(workspace, packages=packages)


PACKAGING = frozenset({"setup.py"})
"""Names of files of a parsed language that say what a whole package is made of."""


def left_out_of(files: Sequence[SourceFile], unchanged: Mapping[str, str]) -> frozenset[str]:
    """Return the paths of the sources of a package that say nothing of what is found in those that changed.

    Beside what changed, files of the same name are looked at: a source and its header are judged together. Where
    something else than a source changed (manifest, build, launch file), all of the package is looked at.

    Args:
        files: of the package.
        unchanged: hashes that files had, by path.
    """
    changed = [file for file in files if unchanged.get(file.path) != file.content_hash]
    if any(not file.language.parsed_as or PurePosixPath(file.path).name in PACKAGING for file in changed):
        return frozenset()
    paths, stems = {file.path for file in changed}, {PurePosixPath(file.path).stem for file in changed}
    return frozenset(
        file.path
        for file in files
        if file.language.parsed_as and file.path not in paths and PurePosixPath(file.path).stem not in stems
    )
