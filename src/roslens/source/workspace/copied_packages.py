"""Packages of others' projects that were committed into a repository beside its own packages.

The manifest and the change log keep where a package is from. A package came from elsewhere where it was released by
itself (a ``CHANGELOG.rst`` of bloom with the date of a release), where its manifest names a repository that is named
as the package or as a folder around it, where all its maintainers are of makers whose packages are often copied, where
it has a name that a project of others published, or where it lies in a project that was put there as a whole and names
people who committed nothing to the repository: in an unpacked archive, or in a folder with a licence and a text to read
first, beside packages that lie in none. It is at home all the same

* at the root of the workspace, in a repository of that name, or in a checkout of its own;
* where half of all packages or more have its version, name its repository or are of the same maker, unless its name is
  one that others published;
* where its people, or others of their organisation, maintain a package that did not come from elsewhere, and so are
  all packages of its version.

Where nothing is left that is at home, everything is: such a workspace was put together from projects.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from functools import lru_cache

import msgspec

from roslens.model.source import Package, Person
from roslens.source.workspace.published_projects import published_elsewhere
from roslens.source.workspace.unpacked_projects import unpacked_project

CHANGE_LOG = "CHANGELOG.rst"
"""Where bloom expects what changed in a release, beside the manifest."""

_TITLE = re.compile(rb"^Changelog for package ([\w-]+)", re.MULTILINE)
_RELEASE = re.compile(rb"^\d+\.\d+\.\d+ \(\d{4}-\d\d-\d\d\)", re.MULTILINE)
_REPOSITORY = re.compile(r"(?:github\.com|gitlab\.com|bitbucket\.org)[/:]([\w.-]+/[\w.-]+)", re.IGNORECASE)
_ANYBODY = re.compile(
    r"(?:g(?:oogle)?mail|outlook|hotmail|live|yahoo|icloud|me|mail|gmx|web|proton(?:mail)?|qq|163|126|naver|yandex)\."
    r"[\w.]+|(?:users\.noreply\.)?github\.com|todo\.todo|(?:example|test)\.\w+|todo|localhost",
    re.IGNORECASE,
)
"""Hosts of addresses that say nothing of an organisation."""
_MAKERS = re.compile(
    r"(?:.+\.)?(?:osrfoundation\.org|openrobotics\.org|willowgarage\.com|clearpath(?:robotics)?\.(?:com|ai)|intel\.com"
    r"|slamtec\.com|cygbot\.com|stereolabs\.com|pal-robotics\.com|fetchrobotics\.com|anybotics\.com|robotis\.com"
    r"|dronesolutions\.io|movella\.com|xsens\.com|ydlidar\.com|eaibot\.com|orbbec\.com|luxonis\.com|livoxtech\.com"
    r"|hesaitech\.com|robosense\.(?:cn|ai)|ouster\.(?:io|com)|velodyne(?:lidar)?\.com|sick\.(?:de|com)|hokuyo-aut\.jp|flir\.com"
    r"|phidgets\.com|lordmicrostrain\.com|microstrain\.com|sbg-systems\.com|vectornav\.com"
    r"|yujinrobot\.com|unity3d\.com|foxglove\.dev|autoware\.org|tier4\.jp"
    r"|intermodalics\.eu|universal-robots\.com|kinova(?:robotics)?\.(?:ca|com)|trossenrobotics\.com|unitree\.(?:cc|com)"
    r"|(?:sim|fsr)\.tu-darmstadt\.de|bovbel\.com|ericperko\.com)",
    re.IGNORECASE,
)
"""Hosts of the addresses of makers of drivers, simulators and libraries: each was seen in repositories of others."""
_HALF = 0.5
_LEAST_WORD = 3
_NOBODY = frozenset(
    ("todo", "user", "root", "you", "your", "name", "email", "maintainer", "author", "none", "dev", "ros")
)
"""What templates write for somebody."""


class Candidate(msgspec.Struct, frozen=True):
    """A package of a workspace, and what can be known of where it is from.

    Attributes:
        package: as its manifest declares it.
        read_log: returns its change log; None where it has none.
        own_checkout: whether its folder, or one around it below the root, is a checkout by itself.
        in_project: whether a folder around it, below the root, has a licence and a text to read first.
    """

    package: Package
    read_log: Callable[[], bytes] | None
    own_checkout: bool = False
    in_project: bool = False


def copied_packages(
    candidates: Sequence[Candidate], homes: Set[str], committers: Callable[[], Set[str]] = frozenset
) -> Mapping[str, str]:
    """Return the packages that are copies, by id, with what each is a copy of.

    Args:
        candidates: all packages of the workspace.
        homes: names that the repository of the workspace itself has, in lower case.
        committers: returns names and addresses of those who committed to it, in lower case; none where that is unknown.
    """
    named = {one.package.id: repositories_named(one.package) for one in candidates}
    released = {one.package.id for one in candidates if one.read_log is not None and _is_released(one)}
    published = published_elsewhere([one.package.name for one in candidates], homes)
    elsewhere = [
        one
        for one in candidates
        if _may_be_a_copy(one)
        and (
            one.package.name in published
            or _is_from_elsewhere(one, released, named, homes)
            or _is_put_there(one, homes, committers)
        )
    ]
    if not elsewhere:
        return {}
    versions, repositories = _usual(candidates, released, named)
    makers = Counter(host for one in candidates for host in _makers(one.package))
    usual_makers = {host for host, count in makers.items() if count >= _HALF * len(candidates)}
    away = [
        one
        for one in elsewhere
        if one.package.name in published
        or (
            repositories.isdisjoint(named[one.package.id])
            and usual_makers.isdisjoint(_makers(one.package))
            and not (one.package.id in released and one.package.version in versions)
        )
    ]
    ids = {one.package.id for one in away}
    at_home = [one for one in candidates if one.package.id not in ids]
    people = {key for one in at_home for key in _people(one.package)}
    kept = [one for one in away if not people.isdisjoint(_people(one.package))]
    kept_versions = {one.package.version for one in kept if one.package.id in released}
    ids -= {one.package.id for one in kept}
    ids -= {one.package.id for one in away if one.package.id in released and one.package.version in kept_versions}
    if not at_home:
        return {}
    return {
        one.package.id: _origin(one.package, named, published.get(one.package.name, one.package.name))
        for one in away
        if one.package.id in ids
    }


@lru_cache(maxsize=4096)
def _repositories_in(urls: tuple[str, ...]) -> tuple[str, ...]:
    found = (match.lower().removesuffix(".git") for url in urls for match in _REPOSITORY.findall(url))
    return tuple(dict.fromkeys(found))


def repositories_named(package: Package) -> tuple[str, ...]:
    """Return the repositories that the URLs of a manifest name, as ``owner/name`` in lower case."""
    return _repositories_in(tuple(url.url for url in package.urls))


def _is_released(one: Candidate) -> bool:
    """Return whether the change log has the package's name in its title and the date of a release."""
    if one.read_log is None:
        return False
    text = one.read_log()
    title = _TITLE.search(text)
    return title is not None and title[1].decode("ascii", "replace") == one.package.name and bool(_RELEASE.search(text))


def _may_be_a_copy(one: Candidate) -> bool:
    """Return whether a package lies in a repository that may be of others: not at its root, and no checkout."""
    return one.package.path not in ("", ".") and not one.own_checkout


def _is_from_elsewhere(
    one: Candidate, released: Set[str], named: Mapping[str, tuple[str, ...]], homes: Set[str]
) -> bool:
    package = one.package
    names = _names(named[package.id])
    if not names.isdisjoint(homes):
        return False
    return package.id in released or _is_in_its_folder(package, names) or bool(_makers(package))


def _is_put_there(one: Candidate, homes: Set[str], committers: Callable[[], Set[str]]) -> bool:
    """Return whether a package lies in a project that was put there as a whole by others than its people."""
    projects = {unpacked_project(part) for part in one.package.path.lower().split("/")} - {"", *homes}
    if not projects and not one.in_project:
        return False
    words = {word for person in (*one.package.maintainers, *one.package.authors) for word in _words(person)}
    known = committers() if words else frozenset[str]()
    return bool(known) and not any(word in other for word in words for other in known)


def _words(person: Person) -> Iterator[str]:
    """Yield what names somebody: the words of the name, and what stands before the host of the address."""
    for word in re.split(r"[^\w-]+", f"{person.name} {person.email.rpartition('@')[0]}".lower()):
        if len(word) >= _LEAST_WORD and word not in _NOBODY:
            yield word


def _makers(package: Package) -> Set[str]:
    """Return the hosts of the makers that all maintainers of a package are of; none where one is of no maker."""
    hosts = {_host(person) for person in package.maintainers}
    return hosts if hosts and all(map(_MAKERS.fullmatch, hosts)) else frozenset()


def _host(person: Person) -> str:
    return person.email.strip().lower().rpartition("@")[2]


def _names(repositories: Sequence[str]) -> Set[str]:
    return {repository.partition("/")[2] for repository in repositories}


def _is_in_its_folder(package: Package, names: Set[str]) -> bool:
    """Return whether a repository that the manifest names is named as the package, or as a folder around it."""
    return not names.isdisjoint((package.name.lower(), *package.path.lower().split("/")))


def _usual(
    candidates: Sequence[Candidate], released: Set[str], named: Mapping[str, tuple[str, ...]]
) -> tuple[Set[str], Set[str]]:
    """Return the versions in which at least half of all packages were released, and the repositories so many name.

    A repository that lies in a folder of its name is not usual, and no version of its packages is: packages of others
    may be the most.
    """
    most = _HALF * len(candidates)
    versions = Counter(one.package.version for one in candidates if one.package.id in released)
    repositories = Counter(name for one in candidates for name in named[one.package.id])
    inside = [one for one in candidates if _is_around(one.package, named[one.package.id])]
    return (
        {version for version, count in versions.items() if count >= most} - {one.package.version for one in inside},
        {name for name, count in repositories.items() if count >= most}
        - {name for one in inside for name in named[one.package.id]},
    )


def _is_around(package: Package, repositories: Sequence[str]) -> bool:
    """Return whether a repository that the manifest names is named as a folder around the package's."""
    return not _names(repositories).isdisjoint(package.path.lower().split("/")[:-1])


@lru_cache(maxsize=4096)
def _keys(person: Person) -> tuple[str, ...]:
    email, host = person.email.strip().lower(), _host(person)
    organisation = f"@{host}" if host and not _ANYBODY.fullmatch(host) else ""
    address = email if organisation or (host and not host.startswith(("todo", "example", "test"))) else ""
    name = person.name.strip().lower()
    return tuple(key for key in (address, organisation, name if " " in name else "") if key)


def _people(package: Package) -> tuple[str, ...]:
    """Return what tells the people of a package: addresses, hosts of their organisations, full names."""
    return tuple(key for person in (*package.maintainers, *package.authors) for key in _keys(person))


def _origin(package: Package, named: Mapping[str, tuple[str, ...]], project: str) -> str:
    """Return what a copied package is a copy of: the repository that it names, or its project; with its version."""
    return " ".join(part for part in (next(iter(named[package.id]), project), package.version) if part)
