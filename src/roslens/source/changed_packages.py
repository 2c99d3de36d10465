"""The packages of a workspace in which a file is not as an earlier state had it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

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
