"""Folders of a package that hold the work of others, recognised by what comes with it.

A folder with a licence of its own, a version in its name, the name of a library that is often copied, the headers of
another package of ROS, or all that a project of its own has. The folder of the package itself is none, whatever it is
named. Where a licence or a project is all that tells, neither are its ``src`` and ``include``, nor one with most of the
package's sources in it.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence, Set
from functools import lru_cache

_LICENCE = re.compile(r"(?:licen[cs]es?|copying|copyright|l?gpl|unlicense)(?:[-_.][\w.-]*)?", re.IGNORECASE)
_NO_LICENCE = (".py", ".h", ".hh", ".hpp", ".cpp", ".cc", ".cxx", ".c", ".cmake", ".xml")
_VERSIONED = re.compile(r"[a-z][a-z0-9_+]{2,}[-_]?v?\d+(?:\.\d+)+(?:[-_.]?\w+)?", re.IGNORECASE)
_UPSTREAM = re.compile(
    r"nlohmann|rapidjson|jsoncpp|json11|rapidxml|pugixml|tinyxml2?|tinyobjloader|miniz|zlib|lz4|zstd|catch2|doctest"
    r"|pybind11|spdlog|fmtlib|eigen3|glm|imgui|implot|nanoflann|(?:rt)?flann|sol2|luajit|qwt|qcustomplot|cppzmq|libzmq"
    r"|magic_enum|robin_hood|concurrentqueue|readerwriterqueue|cli11|cxxopts|exprtk|muparserx?|minitrace|flatbuffers"
    r"|backward[-_]cpp|rxcpp|kissfft|sqlite3|libuv|cpp-httplib|civetweb|websocketpp|jwt-cpp|polyclipping|delaunator"
    r"|absl|abseil-cpp|quadprog(?:pp|\+\+)?|protobuf|or-tools|ortools|glad|deepspeech|optional-lite|span-lite|libb64"
    r"|libcvd|armadillo|armadillo_bits|sophus|airlib|stlsoft|unixstl|winstl|dlib",
    re.IGNORECASE,
)
_LAID_OUT = re.compile(
    r"(?:.*?/)?(?:eigen(?=/(?:eigen/)?src/core/)|mavlink(?=/(?:v[12]\.0/)?mavlink_helpers\.h))", re.IGNORECASE
)
"""A folder whose name is inconclusive and whose content shows its origin."""
_OF_ROS = frozenset((
    "std_msgs", "sensor_msgs", "geometry_msgs", "nav_msgs", "diagnostic_msgs", "visualization_msgs", "trajectory_msgs",
    "shape_msgs", "stereo_msgs", "actionlib_msgs", "rosgraph_msgs", "tf2_msgs", "std_srvs", "diagnostic_updater",
))  # fmt: skip
"""Packages whose headers lie in ``include/<name>/``: where another package has such a folder, it is a copy."""
_BUILD = frozenset((
    "cmakelists.txt", "makefile", "makefile.am", "configure", "configure.ac", "configure.in", "meson.build", "setup.py",
    "sconstruct", "build.sh",
))  # fmt: skip
_READ_FIRST = re.compile(r"readme(?:\.\w+)?")
_OF_A_PROJECT = re.compile(
    r"authors?(?:\.\w+)?|change(?:s|log)(?:\.\w+)?|news(?:\.\w+)?|install(?:\.\w+)?|version(?:\.txt)?"
    r"|contribut(?:ing|ors)(?:\.\w+)?|doxyfile(?:\.in)?|release[-_]?notes(?:\.\w+)?|\.travis\.yml|\.?appveyor\.yml"
    r"|azure-pipelines\.yml|conanfile\.(?:py|txt)|vcpkg\.json"
)
"""What a project has that is released by itself, and hardly a folder of a package."""
_BINARY = re.compile(r".+\.(?:a|so(?:\.\d+)*|lib|dll|dylib)")
_SOURCES = re.compile(r".+\.(?:c|cc|cpp|cxx|h|hh|hpp|hxx|inl|ipp|tpp|cu|cuh|py)")
_OWN = frozenset(("", "src", "include", "scripts", "launch", "msg", "srv", "action", "test", "nodes", "doc", "docs"))
"""Folders that packages have, and the package itself: they are its own whatever licence lies there."""
_MOST = 0.5


def vendored_folders(package: str, paths: Sequence[str], name: str = "") -> tuple[str, ...]:
    """Return the folders of others in a package, each with ``/`` at its end; those below them are left out.

    Args:
        package: folder of the package below the workspace root, ``.`` or empty for that itself.
        paths: of all files of the package, below the workspace root.
        name: of the package, whose own headers are no copies.
    """
    start = "" if package in ("", ".") else f"{package}/"
    sources = [path for path in paths if _SOURCES.fullmatch(path)]
    found: set[str] = set()
    inside: dict[str, set[str]] = {}
    for path in paths:
        if not path.startswith(start):
            continue
        if laid_out := _LAID_OUT.match(path):
            found.add(f"{laid_out[0]}/")
        folders, _, file = path[len(start) :].rpartition("/")
        found.update(f"{start}{one}/" for one in _named(folders, name))
        if folders not in _OWN:
            inside.setdefault(folders, set()).add(file.lower())
    for folder in (f"{start}{one}/" for one, files in inside.items() if _is_of_others(one, files, inside)):
        if sum(path.startswith(folder) for path in sources) <= _MOST * len(sources):
            found.add(folder)
    found = {folder for folder in found if any(path.startswith(folder) for path in sources)}
    return tuple(sorted(one for one in found if not any(one != other and one.startswith(other) for other in found)))


def named_folders(paths: Sequence[str], packages: Sequence[str] = ()) -> tuple[str, ...]:
    """Return the folders outside of packages whose names say that they are of others, each with ``/`` at its end.

    A licence or a project says nothing there: the whole repository has one. Nor does the name of a folder with packages
    in it, which may well have a version: ``robot_v0.2``.

    Args:
        paths: of all files outside of packages, below the workspace root.
        packages: folders of all packages.
    """
    named = {f"{one}/" for path in paths for one in _named(path.rpartition("/")[0], "")}
    return tuple(sorted(one for one in named if not any(package.startswith(one) for package in packages)))


@lru_cache(maxsize=4096)
def _named(folders: str, name: str) -> tuple[str, ...]:
    """Return those of a folder and the folders around it whose names say that they are of others."""
    parts = folders.split("/") if folders else []
    found = []
    for depth, part in enumerate(parts, 1):
        is_copy = part in _OF_ROS and part != name and depth > 1 and parts[depth - 2] == "include"
        if is_copy or _UPSTREAM.fullmatch(part) or _VERSIONED.fullmatch(part):
            found.append("/".join(parts[:depth]))
    return tuple(found)


def _is_of_others(folder: str, files: Set[str], inside: Mapping[str, Set[str]]) -> bool:
    """Return whether the files that lie in a folder say that it came as a whole: its licence, or its project."""
    if any(_LICENCE.fullmatch(one) and not one.endswith(_NO_LICENCE) for one in files):
        return True
    if files.isdisjoint(_BUILD) or not any(map(_READ_FIRST.fullmatch, files)):
        return False
    if any(map(_OF_A_PROJECT.fullmatch, files)):
        return True
    below = f"{folder}/"
    return any(_BINARY.fullmatch(one) for other, each in inside.items() if other.startswith(below) for one in each)
