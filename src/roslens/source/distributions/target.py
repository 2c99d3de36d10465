"""Which distribution of ROS a workspace is meant to run on: said, or guessed from files that build or ship it.

The files that are looked at, in this order: those of continuous integration, those of containers, lists of repositories
(``.repos``); files of one kind in one folder are taken together. Those nearest to a package count, up to the root of
its repository. Where none of them says anything, what people are told to install counts (READMEs, settings of
editors), and ``$ROS_DISTRO`` where no file says anything. Where nothing does, the last commit of the repository tells
which distributions it may be for: those that were supported in the year before it. A standard of C++ is no sign: C++17
is that of Humble to Kilted (REP-2000).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from fnmatch import fnmatchcase
from itertools import islice
from pathlib import Path, PurePosixPath

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.source import Package
from roslens.source.distributions.known_distributions import OLDEST_SUPPORTED, distributions, is_at_least

MOST_BYTES = 300_000
"""Of a file that is looked at."""
MOST_FILES = 60
"""In one folder."""

MOST_NAMES = 500
"""In one file."""

_NAMES = "|".join(distributions())
_IN_CI = re.compile(
    rf"""(?ix) ros [\w./-]* ["']? \s* [:=-] \s* [^\n#]*? (?<![\w-]) (?:{_NAMES}) (?![\w]) [^\n#]*
    | /opt/ros/ (?:{_NAMES}) \b
    | ^ \s* - \s+ ["']? (?:{_NAMES}) ["']? \s* (?:\#.*)? $""",
    re.MULTILINE,
)
_IN_CONTAINER = re.compile(
    rf"(?i)\bros(?:-core|-base)?:(?:{_NAMES})\b|/ros:(?:{_NAMES})\b|/opt/ros/(?:{_NAMES})\b|\bros-(?:{_NAMES})-"
    rf"|ROS_DISTRO[\"']?\s*[=:\s]\s*[\"']?(?:{_NAMES})\b"
)
_IN_DOCUMENT = re.compile(
    rf"(?i)/opt/ros/(?:{_NAMES})\b|\bros-(?:{_NAMES})-|--rosdistro[=\s]+(?:{_NAMES})\b"
    rf"|ROS_DISTRO\W{{1,3}}(?:{_NAMES})\b|\bros(?:\s?[12])?\W{{0,3}}(?:{_NAMES})\b"
)
_DENIED = re.compile(
    r"(?i)(?:\bnot|n\Wt|\bno longer|\bnever|\bnor)\b[^\n]{0,40}\b(?:work|support|compatib|test|run|build|available)"
    r"|\b(?:un(?:supported|tested)|incompatible|broken|fails?|end of life|eol)\b"
    r"|\b(?:check ?out|see|switch(?: to)?|go to|use)\b[^\n]{0,60}\bbranch"
)
"""What a sentence has that names a distribution for which the workspace is not, or for which another branch is."""
_AROUND = 200
"""Characters before and behind a name that may be of its sentence."""
_STOP = re.compile(r"[.!?](?=\s)|\n")
_VERSION = re.compile(rf"^\s*version\s*:\s*[\"']?(?:{_NAMES})(?:-devel)?[\"']?\s*$", re.MULTILINE | re.IGNORECASE)
_NAME = re.compile(rf"(?i)(?<![A-Za-z])(?:{_NAMES})(?![A-Za-z])")

_DOCUMENTATION = re.compile(r"(?i)doc(?!ker)|doxygen|pages")
"""Names of files that build documentation, whatever distribution they do that with."""

_Kind = tuple[tuple[str, ...], re.Pattern[str]]
_BUILDING: tuple[_Kind, ...] = (
    (
        (
            ".github/workflows/*.yml",
            ".github/workflows/*.yaml",
            ".gitlab-ci.yml",
            ".travis.yml",
            "azure-pipelines.yml",
            ".circleci/config.yml",
            "Jenkinsfile",
        ),
        _IN_CI,
    ),
    (
        (
            "Dockerfile*",
            "*.Dockerfile",
            "docker/*Dockerfile*",
            ".docker/*Dockerfile*",
            ".devcontainer/*Dockerfile*",
            ".devcontainer/devcontainer.json",
            "docker-compose.y*ml",
            "compose.y*ml",
        ),
        _IN_CONTAINER,
    ),
    (("*.repos", ".rosinstall", "*.rosinstall"), _VERSION),
)
_TELLING: tuple[_Kind, ...] = ((("README*", "readme*", "INSTALL*", "docs/README*", ".vscode/*.json"), _IN_DOCUMENT),)


class Target(msgspec.Struct, frozen=True, omit_defaults=True):
    """What a package is to be built for.

    Attributes:
        distros: names of distributions, in order of release; empty where nothing is known.
        given: the user said so, where it is not guessed.
        said_by: who says so: ``distro``, which the user set, the path of a file, or ``$ROS_DISTRO``.
        told: people are told so, where nothing that builds says it.
        earlier: where nothing is known, the oldest distributions of each version of ROS that were supported in the year
            before the last commit, where these are earlier than those that are supported now.
    """

    distros: tuple[str, ...] = ()
    given: bool = False
    said_by: str = ""
    told: bool = False
    earlier: tuple[str, ...] = ()

    def oldest(self, ros: int) -> str:
        """Return the oldest distribution of a version of ROS that it may be for, where nothing says for which it is."""
        return next((one for one in self.earlier if distributions()[one].ros == ros), OLDEST_SUPPORTED[ros])

    def of(self, ros: int) -> tuple[str, ...]:
        """Return those of a version of ROS."""
        return tuple(one for one in self.distros if distributions()[one].ros == ros)

    def note(self) -> str:
        """Return it in words, for the head of a report; empty where nothing is known."""
        if not self.distros:
            return ""
        names = ", ".join(distributions()[one].title for one in self.distros)
        return f"for {names}, as {self.said_by} says"


def targets_of(
    root: Path,
    packages: Iterable[Package],
    given: str = "",
    environment: Mapping[str, str] | None = None,
    last_change: Callable[[], str] | None = None,
) -> Mapping[str, Target]:
    """Return what each package is built for, by its id.

    Args:
        root: of the workspace.
        packages: of it.
        given: a distribution that the user named; empty for none.
        environment: variables, of which ``ROS_DISTRO`` counts where no file says anything.
        last_change: returns year and month of the last commit (``2026-03``), or nothing; asked where nothing says it.
    """
    if given:
        said = Target((given,), given=True, said_by="`distro`")
        return {one.id: said for one in packages}
    name = (environment or {}).get("ROS_DISTRO", "")
    by_variable = Target((name,), said_by="$ROS_DISTRO") if name in distributions() else None
    building: dict[Path, Target | None] = {}
    telling: dict[Path, Target | None] = {}
    found = {
        one.id: _guess(root, root / one.path, _BUILDING, building)
        or _guess(root, root / one.path, _TELLING, telling)
        or by_variable
        for one in packages
    }
    is_known = all(one is not None for one in found.values())
    unknown = Target() if is_known or last_change is None else Target(earlier=_earlier(last_change()))
    return {package: target or unknown for package, target in found.items()}


def _earlier(month: str) -> tuple[str, ...]:
    """Return the oldest distribution of each version of ROS that was supported a year before a month, if not now."""
    year, _, rest = month.partition("-")
    if not (year.isdecimal() and rest):
        return ()
    before = f"{int(year) - 1}-{rest}"
    oldest: dict[int, str] = {}
    for one in distributions().values():
        if one.end >= before:
            oldest.setdefault(one.ros, one.name)
    return tuple(name for ros, name in oldest.items() if not is_at_least(name, OLDEST_SUPPORTED[ros]))


def _guess(root: Path, folder: Path, kinds: tuple[_Kind, ...], looked: dict[Path, Target | None]) -> Target | None:
    """Return what the nearest files of some kinds say, from a folder up to the root of its repository."""
    for above in (folder, *folder.parents):
        if above not in looked:
            looked[above] = _said_in(above, root, kinds)
        if (said := looked[above]) is not None:
            return said
        if (above / ".git").exists() or above == above.parent:
            return None
        if above == root and not _is_in_repository(root):
            return None
    return None


def _is_in_repository(root: Path) -> bool:
    return any((above / ".git").exists() for above in root.parents)


def _said_in(folder: Path, root: Path, kinds: tuple[_Kind, ...]) -> Target | None:
    for patterns, expression in kinds:
        said = [(path, names) for path in _files(folder, patterns) if (names := _named(path, expression))]
        if said:
            found = {name for _, names in said for name in names}
            names = tuple(name for name in distributions() if name in found)
            return Target(names, said_by=_shown(said[0][0], root), told=kinds is _TELLING)
    return None


def _files(folder: Path, patterns: Iterable[str]) -> Iterator[Path]:
    """Yield files of a folder that match patterns of one or more parts, in order of the patterns, then of names."""
    for pattern in patterns:
        part = PurePosixPath(pattern)
        inside = folder / part.parent
        try:
            names = sorted(one.name for one in inside.iterdir())[: MOST_FILES * 20]
        except OSError:
            continue
        matching = [name for name in names if fnmatchcase(name, part.name) and not _DOCUMENTATION.search(name)]
        yield from (inside / name for name in matching[:MOST_FILES])


def _named(path: Path, expression: re.Pattern[str]) -> tuple[str, ...]:
    try:
        text = read_bounded(path, MOST_BYTES).decode("utf-8", "replace")
    except (OSError, ValueError):
        return ()
    # In a document a sign that begins comments elsewhere begins a title.
    code = text if expression is _IN_DOCUMENT else _without_comments(text)
    matches: Iterable[re.Match[str]] = islice(expression.finditer(code), MOST_NAMES)
    if expression is _IN_DOCUMENT:
        matches = (one for one in matches if not _DENIED.search(_sentence(code, one)))
    found = {name.lower() for match in matches for name in _NAME.findall(match[0])}
    return tuple(name for name in distributions() if name in found)


def _sentence(text: str, match: re.Match[str]) -> str:
    """Return what stands around a match, up to the ends of its sentence or line, and no more than is read at once."""
    before = text[max(0, match.start() - _AROUND) : match.start()]
    behind = text[match.end() : match.end() + _AROUND]
    return f"{_STOP.split(before)[-1]}{match[0]}{_STOP.split(behind, maxsplit=1)[0]}"


def _without_comments(text: str) -> str:
    return "\n".join(line for line in text.splitlines() if not line.lstrip().startswith("#"))


def _shown(path: Path, root: Path) -> str:
    try:
        return path.relative_to(root).as_posix()
    except ValueError:
        return path.name
