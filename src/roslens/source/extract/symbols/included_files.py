"""Which files of the workspace a file of C++ includes, and which it sees by that."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from os.path import commonpath
from types import MappingProxyType

from roslens.source.extract.ir.program import Program

HEADERS = (".h", ".hpp", ".hh", ".hxx")
"""Ends of the names of files that others include."""
Packages = Mapping[str, str]
"""The package of each file."""
Needs = Mapping[str, Collection[str]]
"""The packages that each package depends on."""


def included_files(
    programs: Mapping[str, Program], packages: Packages = MappingProxyType({}), needs: Needs = MappingProxyType({})
) -> dict[str, tuple[str, ...]]:
    """Return the files of the workspace that each file of C++ includes itself.

    Where several end in what is written, the one of the own package is meant, else of one that it depends on, else the
    nearest.
    """
    by_name: dict[str, list[str]] = {}
    for path, program in programs.items():
        if program.language != "python":
            by_name.setdefault(path.rpartition("/")[2], []).append(path)
    found: dict[str, tuple[str, ...]] = {}
    for path, program in programs.items():
        if program.language == "python" or not program.includes:
            continue
        fitting = (_fitting(line.strip('<>"'), by_name) for line, _ in program.includes)
        meant = (fit[0] if len(fit) == 1 else _nearest(fit, path, packages, needs) for fit in fitting if fit)
        found[path] = tuple(dict.fromkeys(meant))
    return found


def _fitting(wanted: str, by_name: Mapping[str, Sequence[str]]) -> list[str]:
    """Return the files whose path ends in what is written."""
    named = by_name.get(wanted.rpartition("/")[2])
    if named is None:
        return []
    end = f"/{_plain(wanted)}"
    return [one for one in named if f"/{one}".endswith(end)]


def reached(start: str, edges: Mapping[str, Collection[str]]) -> set[str]:
    """Return what edges lead to from a file, the file itself among it."""
    seen, waiting = {start}, [start]
    while waiting:
        for path in edges.get(waiting.pop(), ()):
            if path not in seen:
                seen.add(path)
                waiting.append(path)
    return seen


def including(programs: Mapping[str, Program], packages: Packages, needs: Needs) -> dict[str, set[str]]:
    """Return the files that include each file of the workspace themselves."""
    return inverted(included_files(programs, packages, needs))


def inverted(edges: Mapping[str, Collection[str]]) -> dict[str, set[str]]:
    """Return edges the other way round."""
    found: dict[str, set[str]] = {}
    for start, ends in edges.items():
        for end in ends:
            found.setdefault(end, set()).add(start)
    return found


def _plain(wanted: str) -> str:
    """Return a path without what leads out of the folder of the file: ``../include/a.h`` is ``include/a.h``."""
    while wanted.startswith(("./", "../")):
        wanted = wanted.partition("/")[2]
    return wanted


def _nearest(headers: Sequence[str], path: str, packages: Packages, needs: Needs) -> str:
    own = packages.get(path, "")
    depends = needs.get(own, ())

    def rank(one: str) -> tuple[bool, bool, int, str]:
        package = packages.get(one, "")
        return bool(own) and package == own, package in depends, len(commonpath((one, path))), one

    return max(headers, key=rank)
