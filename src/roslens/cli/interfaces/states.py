"""The interfaces of the files as they are, of a revision, or of a lock file."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

if TYPE_CHECKING:
    from roslens.source.extract.workspace.interface_state import InterfaceState
    from roslens.source.settings import SourceSettings


def state_of_tree(root: Path, settings: SourceSettings) -> InterfaceState:
    """Return the interfaces of the files as they are.

    Raises:
        UsageError: there is no such folder.
    """
    from roslens.source.extract.workspace.interface_state import interface_state

    return interface_state(root, _seen(settings))


def state_of_revision(root: Path, commit: str, settings: SourceSettings) -> InterfaceState:
    """Return the interfaces of a commit of the repository that a folder is in; nothing is checked out.

    Raises:
        UsageError: git cannot give the files.
    """
    from roslens.cli.git.git_repository import repository_of
    from roslens.cli.git.git_tree import write_tree
    from roslens.source.extract.workspace.interface_state import interface_state, is_of_interfaces

    with tempfile.TemporaryDirectory(prefix="roslens-interfaces-") as folder:
        write_tree(repository_of(str(root)), commit, Path(folder), only=is_of_interfaces)
        return interface_state(folder, _seen(settings))


def state_before(root: Path, name: str, settings: SourceSettings) -> tuple[str, InterfaceState]:
    """Return what a lock file or a revision is called, with its interfaces.

    Raises:
        UsageError: it is neither, or cannot be read.
    """
    from roslens.cli.git.revision import revision_of
    from roslens.cli.interfaces.lock_file import read_lock

    if Path(name).is_file():
        return name, read_lock(Path(name))
    revision = revision_of(root, name)
    return revision.title, state_of_revision(root, revision.commit, settings)


def _seen(settings: SourceSettings) -> SourceSettings:
    """Return settings with the variables that conditions of manifests see."""
    from roslens.source.workspace.conditions import environment_of

    seen = {**environment_of(os.environ), **settings.workspace.environment}
    return msgspec.structs.replace(settings, workspace=msgspec.structs.replace(settings.workspace, environment=seen))
