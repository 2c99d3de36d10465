"""Files of the form ``.repos`` (vcs2l): what others wrote, and what roslens writes as its lock.

The lock is a ``.repos`` file whose versions are commits, so that ``vcs import`` takes it too; what roslens needs
besides stands below the key ``roslens`` of each repository, which others pass over.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from roslens.model.errors import UsageError
from roslens.model.failure import Failure
from roslens.source.fetch.distribution import Distribution
from roslens.source.fetch.refs import is_commit
from roslens.source.fetch.taken import How, Taken
from roslens.source.fetch.urls import without_password
from roslens.source.fetch.wanted import Wanted

_HEAD = """\
# Written by `roslens fetch`. The same tree on another machine: roslens fetch --distribution fetched.repos
"""


def is_repos_file(data: Mapping[str, Any]) -> bool:
    """Return whether the values are those of a ``.repos`` file rather than of a distribution file."""
    return "repositories" in data and data.get("type") != "distribution"


def repositories_of(data: Mapping[str, Any], place: str, *, remote: bool = False) -> Distribution:
    """Return the repositories that a ``.repos`` file names, those of a lock at their commits.

    Raises:
        UsageError: it is none.
    """
    entries = data.get("repositories") or {}
    if not isinstance(entries, Mapping):
        raise UsageError(f'"{place}": repositories is not a table', expected="a .repos file")
    found, failures = [], []
    for name in sorted(entries, key=str):
        entry = entries[name]
        if not isinstance(entry, Mapping) or not isinstance(entry.get("url"), str) or not entry["url"]:
            failures.append(
                Failure(
                    "fetch", "it has no url", "type, url and version", f'See "{place}"', entity=f"repository:{name}"
                )
            )
            continue
        version = entry.get("version")
        own = entry.get("roslens")
        own = own if isinstance(own, Mapping) else {}
        packages = own.get("packages")
        found.append(
            Wanted(
                str(name),
                entry["url"],
                "" if version is None else str(version),
                str(entry.get("type", "git")),
                tuple(map(str, packages)) if isinstance(packages, list) else (),
                branch=str(own.get("version", "")),
            )
        )
    return Distribution("", tuple(found), tuple(failures), remote=remote, chosen=True)


def lock_text(taken: Iterable[Taken]) -> str:
    """Return the text of the lock: every repository at its commit, failed ones at what was asked for."""
    import yaml

    entries = {one.wanted.name: _entry(one) for one in sorted(taken, key=lambda one: one.wanted.name)}
    return _HEAD + yaml.safe_dump({"repositories": entries}, sort_keys=False, allow_unicode=True, width=120)


def _entry(taken: Taken) -> dict[str, object]:
    wanted = taken.wanted
    facts = {
        "branch": wanted.branch,
        "at": taken.at,
        "wanted_commits": wanted.commits,
        "commits": taken.commits,
        "day": taken.day,
        "depth": taken.depth,
        "whole": taken.whole,
        "submodules": taken.submodules,
        "packages": list(wanted.packages),
        "failure": taken.failure,
    }
    own = {"version": wanted.version, **{key: value for key, value in facts.items() if value}}
    version = {"version": taken.commit or wanted.version} if taken.commit or wanted.version else {}
    return {"type": wanted.kind, "url": without_password(wanted.url), **version, "roslens": own}


def taken_of(data: Mapping[str, Any]) -> list[Taken]:
    """Return the fetched repositories of a lock; entries that are not roslens' own are left out."""
    entries = data.get("repositories")
    found = []
    for name, entry in entries.items() if isinstance(entries, Mapping) else ():
        own = entry.get("roslens") if isinstance(entry, Mapping) else None
        if not isinstance(own, Mapping) or not isinstance(entry.get("url"), str):
            continue
        packages = own.get("packages")
        wanted = Wanted(
            str(name),
            entry["url"],
            str(own.get("version", "")),
            str(entry.get("type", "git")),
            tuple(map(str, packages)) if isinstance(packages, list) else (),
            _number(own.get("wanted_commits")),
            str(own.get("branch", "")),
        )
        failure = str(own.get("failure", ""))
        version = str(entry.get("version", ""))
        found.append(
            Taken(
                wanted,
                How.FAILED if failure else How.KEPT,
                str(own.get("at", "")),
                version if is_commit(version) and (version != wanted.version or not failure) else "",
                _number(own.get("commits")),
                str(own.get("day", "")),
                _number(own.get("depth")),
                own.get("whole") is True,
                failure=failure,
                submodules=own.get("submodules") is True,
            )
        )
    return found


def _number(value: object) -> int:
    return value if isinstance(value, int) and not isinstance(value, bool) else 0
