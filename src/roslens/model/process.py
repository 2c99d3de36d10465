"""Process metrics of a repository, its packages and their files, from its history."""

from __future__ import annotations

import msgspec


class Release(msgspec.Struct, frozen=True):
    """A tag that names a version.

    Attributes:
        name: of the tag.
        commit: that it is of.
        time_s: when that was committed, in seconds since 1970.
    """

    name: str
    commit: str
    time_s: int


class Coupling(msgspec.Struct, frozen=True):
    """Two files or packages that change together.

    Attributes:
        first: path or id.
        second: path or id.
        shared: how many commits change both.
        degree: that number by the mean of the numbers of commits that change each.
    """

    first: str
    second: str
    shared: int
    degree: float


class RepositoryProcess(msgspec.Struct, frozen=True, omit_defaults=True):
    """The process metrics of one repository of a workspace.

    Attributes:
        path: of its root below that of the workspace; ``.`` where the workspace is in it.
        head: the commit that was looked at.
        head_s: when that was committed, in seconds since 1970.
        as_of_s: the time at which ages are taken; the head's own unless one was given.
        skewed: how many commits are dated before a parent of theirs.
        skew_s: by how much the worst of them.
        values: of the repository, by quantity.
        packages: values by package id.
        files: values by path below the root of the workspace.
        coupled_files: pairs of files that change together.
        coupled_packages: pairs of packages that do.
        releases: the newest first.
    """

    path: str
    head: str
    head_s: int
    as_of_s: float
    skewed: int = 0
    skew_s: int = 0
    values: dict[str, float] = {}
    packages: dict[str, dict[str, float]] = {}
    files: dict[str, dict[str, float]] = {}
    coupled_files: tuple[Coupling, ...] = ()
    coupled_packages: tuple[Coupling, ...] = ()
    releases: tuple[Release, ...] = ()
