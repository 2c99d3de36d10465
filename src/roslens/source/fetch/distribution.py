"""Index and distribution files of ROS (REP 141, REP 143, REP 153), as the rosdistro library understands them.

Repositories are given to it one by one, so that one that is wrong is a failure and the others stand.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec

from roslens.intake.safe_yaml import UnsafeYamlError, load_yaml
from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.source.fetch.document import Read, is_url
from roslens.source.fetch.wanted import Wanted

_SECTIONS = ("doc", "release", "source")


class Distribution(msgspec.Struct, frozen=True):
    """The entries of documents on repositories.

    Attributes:
        name: of the distribution; empty where a file names none.
        repositories: in the order of their names.
        failures: repositories of which the documents say something that cannot be understood.
        remote: whether a document came over the network.
        chosen: whether the packages of a repository are those that somebody wants, rather than all that it has.
    """

    name: str
    repositories: tuple[Wanted, ...]
    failures: tuple[Failure, ...] = ()
    remote: bool = False
    chosen: bool = False


def index_url() -> str:
    """Return where the index is: ``$ROSDISTRO_INDEX_URL``, what the user configured for rosdistro, or that of ROS."""
    return str(_library().get_index_url())


def read_distribution(read: Read, name: str, index: str) -> Distribution:
    """Return the repositories of a distribution of an index.

    Args:
        read: gets documents.
        name: as ``jazzy``.
        index: path or URL of the index.

    Raises:
        UsageError: the index or a file of it cannot be read, or has no such distribution.
    """
    rosdistro = _library()
    data = _mapping(read(index), index)
    base = index.rpartition("/")[0] or "."
    try:
        known = rosdistro.Index(data, base).distributions
    except Exception as error:  # the library asserts, and trips over what is not a table
        raise UsageError(f'"{index}" is not an index of distributions: {error}', expected="an index-v4.yaml") from error
    if name not in known:
        from difflib import get_close_matches

        near = get_close_matches(name, known, 1)
        raise UsageError(
            f'"{index}" has no distribution {name!r}',
            expected=f"one of {', '.join(sorted(known))}",
            advice=f"Did you mean {near[0]!r}?" if near else "",
        )
    files = known[name].get("distribution", [])
    places = [files] if isinstance(files, str) else list(files)
    found: dict[str, Wanted] = {}
    failures: list[Failure] = []
    for place in places:
        inside = distribution_of(_mapping(read(place), place), place, name)
        found.update((one.name, one) for one in inside.repositories)
        failures += inside.failures
    return Distribution(name, tuple(found.values()), tuple(failures), remote=any(map(_is_remote, (index, *places))))


def distribution_of(data: Mapping[str, Any], place: str, name: str = "") -> Distribution:
    """Return the repositories that a distribution file of format 1 or 2 names.

    Args:
        data: values of the document.
        place: path or URL of it.
        name: of the distribution, which the file does not tell.

    Raises:
        UsageError: it is no distribution file, or of another format.
    """
    from rosdistro.distribution_file import DistributionFile

    repositories = data.get("repositories") or {}
    if not isinstance(repositories, Mapping):
        raise UsageError(f'"{place}": repositories is not a table', expected="a distribution file")
    try:
        DistributionFile(name, {**data, "repositories": {}, "release_platforms": {}})
    except Exception as error:
        raise UsageError(
            f'"{place}" is not a supported distribution file: {error}',
            expected="type: distribution, and version: 1 or 2",
        ) from error
    found: list[Wanted] = []
    failures: list[Failure] = []
    for key in sorted(repositories, key=str):
        try:
            found += _wanted(str(key), repositories[key])
        except Exception as error:  # noqa: BLE001 - see above: one repository's mistake is a failure, the others go on
            what = str(error) or type(error).__name__
            failures.append(
                Failure(
                    "fetch",
                    f"its entry could not be parsed: {what}",
                    "source, doc or release with a url",
                    f'See "{place}"',
                    entity=f"repository:{key}",
                )
            )
    return Distribution(name, tuple(found), tuple(failures), remote=_is_remote(place))


def _wanted(name: str, data: Mapping[str, Any]) -> list[Wanted]:
    """Return a repository by its source entry, else by its doc entry; where only releases are known, a tag a package.

    A section that is wrong does not lose what another one says.
    """
    wrong: list[Exception] = []
    release = _section(name, "release", data, wrong)
    packages = tuple(map(str, release.package_names)) if release else ()
    section = _section(name, "source", data, wrong) or _section(name, "doc", data, wrong)
    if section is not None:
        version = str(section.version) if section.version is not None else ""
        return [Wanted(name, str(section.url), version, str(section.type), packages)]
    if release is None:
        raise wrong[0] if wrong else ValueError("neither source nor doc nor release")
    if not release.version:
        raise ValueError("only a release section, and it has no version")
    return [
        Wanted(
            name if len(packages) == 1 else f"{name}/{package}",
            str(release.url),
            release.get_release_tag(package),
            str(release.type),
            (package,),
        )
        for package in packages
    ]


def _section(name: str, key: str, data: Mapping[str, Any], wrong: list[Exception]) -> Any:
    from rosdistro.repository import Repository

    if not data.get(key):
        return None
    try:
        repository = Repository(
            name, **{f"{one}_data": data.get(one) if one == key else None for one in _SECTIONS}, status_data={}
        )
    except Exception as error:  # noqa: BLE001 - see above
        wrong.append(error)
        return None
    return getattr(repository, f"{key}_repository")


def _mapping(content: bytes, place: str) -> dict[str, Any]:
    try:
        data = load_yaml(content)
    except UnsafeYamlError as error:
        raise UsageError(f'"{place}" cannot be read: {error}', expected="YAML") from error
    if not isinstance(data, dict):
        raise UsageError(f'"{place}" is not a table', expected="an index, a distribution file or a .repos file")
    return data


def read_mapping(read: Read, place: str) -> dict[str, Any]:
    """Return the values of a document of YAML.

    Raises:
        UsageError: it cannot be read, or is not a table.
    """
    return _mapping(read(place), place)


def _is_remote(place: str) -> bool:
    return is_url(place) and not place.startswith("file://")


def _library() -> Any:
    try:
        import rosdistro
    except ImportError as error:
        raise UsageError(
            "the library rosdistro, which reads distribution files, is not installed",
            expected="roslens[fetch]",
            advice="Install it with `pip install roslens[fetch]`; .repos files are read without it",
        ) from error
    return rosdistro
