"""Folders of a package that hold the work of others, told by what comes with it.

A folder with a licence of its own, a version in its name, or the name of a library that is often copied. The folder of
the package itself is none, whatever it is named. Where a licence is all that tells, neither are its ``src`` and
``include``, nor one with most of the package's sources in it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

_LICENCE = re.compile(r"(?:licen[cs]es?|copying|unlicense)(?:[-_.][\w.-]*)?", re.IGNORECASE)
_NO_LICENCE = (".py", ".h", ".hpp", ".cpp", ".c", ".cmake", ".xml")
_VERSIONED = re.compile(r"[a-z][a-z0-9_+]{2,}[-_]?v?\d+(?:\.\d+)+(?:[-_.]?\w+)?", re.IGNORECASE)
_UPSTREAM = re.compile(
    r"nlohmann|rapidjson|jsoncpp|json11|rapidxml|pugixml|tinyxml2?|tinyobjloader|miniz|zlib|lz4|zstd|catch2|doctest"
    r"|pybind11|spdlog|fmtlib|eigen3|glm|imgui|implot|nanoflann|(?:rt)?flann|sol2|luajit|qwt|qcustomplot|cppzmq|libzmq"
    r"|magic_enum|robin_hood|concurrentqueue|readerwriterqueue|cli11|cxxopts|exprtk|muparserx?|minitrace|flatbuffers"
    r"|backward[-_]cpp|rxcpp|kissfft|sqlite3|libuv|cpp-httplib|civetweb|websocketpp|jwt-cpp|polyclipping|delaunator"
    r"|absl|abseil-cpp|protobuf|or-tools|ortools|glad|optional-lite|span-lite|libb64",
    re.IGNORECASE,
)
_LAID_OUT = re.compile(r"(?:.*?/)?eigen(?=/(?:eigen/)?src/core/)", re.IGNORECASE)
"""A folder whose name says little and whose inside says whose it is."""
_SOURCES = re.compile(r".+\.(?:c|cc|cpp|cxx|h|hh|hpp|hxx|inl|ipp|tpp|cu|cuh|py)")
_OWN = frozenset(("", "src", "include", "scripts", "launch", "msg", "srv", "action", "test", "nodes"))
"""Folders that packages have, and the package itself: they are its own whatever licence lies there."""
_MOST = 0.5


def vendored_folders(package: str, paths: Sequence[str]) -> tuple[str, ...]:
    """Return the folders of others in a package, each with ``/`` at its end; those below them are left out.

    Args:
        package: folder of the package below the workspace root, ``.`` or empty for that itself.
        paths: of all files of the package, below the workspace root.
    """
    start = "" if package in ("", ".") else f"{package}/"
    sources = [path for path in paths if _SOURCES.fullmatch(path)]
    found: set[str] = set()
    licensed: set[str] = set()
    for path in paths:
        if not path.startswith(start):
            continue
        if laid_out := _LAID_OUT.match(path):
            found.add(f"{laid_out[0]}/")
        folders, _, name = path[len(start) :].rpartition("/")
        parts = folders.split("/") if folders else []
        for depth, part in enumerate(parts, 1):
            if _UPSTREAM.fullmatch(part) or _VERSIONED.fullmatch(part):
                found.add(f"{start}{'/'.join(parts[:depth])}/")
        if folders not in _OWN and _LICENCE.fullmatch(name) and not name.endswith(_NO_LICENCE):
            licensed.add(f"{start}{folders}/")
    for folder in licensed:
        inside = sum(path.startswith(folder) for path in sources)
        if inside and inside <= _MOST * len(sources):
            found.add(folder)
    found = {folder for folder in found if any(path.startswith(folder) for path in sources)}
    return tuple(sorted(one for one in found if not any(one != other and one.startswith(other) for other in found)))
