"""A workspace that was fetched: which of its packages are wanted, and which repositories are missing."""

from __future__ import annotations

import os
from pathlib import Path

import msgspec

from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.model.source import OUTSIDE_PACKAGES, Location
from roslens.source.fetch.taken import LOCK, Taken
from roslens.source.workspace.find import FoundPackage, Workspace


class FetchedSet(msgspec.Struct, frozen=True):
    """The content of the lock of a workspace.

    Attributes:
        taken: repositories by their folder below the root.
        failures: the lock itself, where it cannot be read.
    """

    taken: dict[str, Taken]
    failures: tuple[Failure, ...] = ()

    @property
    def wanted(self) -> dict[str, frozenset[str]]:
        """The names of the packages that are wanted, by folder of their repository; of others all are."""
        return {path: frozenset(one.wanted.packages) for path, one in self.taken.items() if one.wanted.packages}

    def only_wanted(self, workspace: Workspace) -> Workspace:
        """Return the workspace with only the packages that are wanted; nothing is said of what is missing."""
        wanted = self.wanted
        if not wanted:
            return workspace
        return msgspec.structs.replace(
            workspace, packages=tuple(found for found in workspace.packages if _is_wanted(found, wanted))
        )

    def narrowed(self, workspace: Workspace) -> Workspace:
        """Return the workspace with only the packages that are wanted, and with what is missing as failures."""
        if not self.taken and not self.failures:
            return workspace
        kept = self.only_wanted(workspace).packages
        names: dict[str, set[str]] = {}
        for found in kept:
            names.setdefault(folder_among(found.package.path, self.taken), set()).add(found.package.name)
        missing = [_missing(path, one) for path, one in sorted(self.taken.items()) if one.failure]
        for path, one in sorted(self.taken.items()):
            absent = [name for name in one.wanted.packages if name not in names.get(path, ())]
            missing += [_absent(path, one, name) for name in absent if one.commit and not one.failure]
        return msgspec.structs.replace(
            workspace, packages=kept, failures=(*workspace.failures, *missing, *self.failures)
        )


def only_fetched(workspace: Workspace, past_of: str | None = None) -> tuple[FetchedSet, Workspace]:
    """Return the lock of a workspace, and the workspace with only the locked repositories.

    Args:
        workspace: with all its packages.
        past_of: where it holds a past revision of another workspace, the root of that, whose lock says what is wanted;
            what is missing today is then no failure.
    """
    if past_of is not None:
        return FetchedSet({}), read_fetched_set(past_of).only_wanted(workspace)
    fetched = read_fetched_set(workspace.root)
    return fetched, fetched.narrowed(workspace)


def read_fetched_set(root: str) -> FetchedSet:
    """Return the lock in the root of a workspace; nothing without one."""
    if not os.path.lexists(Path(root, LOCK)):
        return FetchedSet({})
    # Almost no workspace has one, and what reads it imports what talks to servers.
    from roslens.source.fetch.journal import read_lock

    try:
        taken = read_lock(Path(root))
    except UsageError as error:
        return FetchedSet({}, (Failure("fetch", error.what, error.expected, error.advice, Location(LOCK)),))
    return FetchedSet({one.wanted.name: one for one in taken})


def folder_among(path: str, folders: dict[str, Taken]) -> str:
    """Return the folder that a path is in or is; empty for none of them."""
    while path:
        if path in folders:
            return path
        path = path.rpartition("/")[0]
    return ""


def _is_wanted(found: FoundPackage, wanted: dict[str, frozenset[str]]) -> bool:
    if found.package.id == OUTSIDE_PACKAGES:
        return not wanted
    parts = found.package.path.split("/")
    for end in range(1, len(parts) + 1):
        names = wanted.get("/".join(parts[:end]))
        if names is not None:
            return found.package.name in names
    return True


def _missing(path: str, taken: Taken) -> Failure:
    return Failure(
        "fetch",
        f"the repository was not fetched: {taken.failure}",
        f"{taken.wanted.url}" + (f" at {taken.wanted.version}" if taken.wanted.version else ""),
        "`roslens fetch` tries again",
        entity=f"repository:{path}",
        partial=bool(taken.commit),
    )


def _absent(path: str, taken: Taken, name: str) -> Failure:
    return Failure(
        "fetch",
        f"the package {name!r} is not in it at {taken.commit[:12]}",
        "the packages that are wanted of it",
        "Fetch another revision, or leave the package out",
        entity=f"repository:{path}",
    )
