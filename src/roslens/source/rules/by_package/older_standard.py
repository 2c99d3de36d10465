"""Packages built with a standard of C++ from before C++17: what that one removed is still there for them.

A specification of exceptions is a mistake where nothing pins a standard, as compilers take C++17 and later by
themselves. Of the library, compilers keep what C++17 removed: that is a mistake where a package asks for C++17, or is
for ROS 2. Elsewhere it is what stands in the way of a newer one.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence, Set

import msgspec

from roslens.model.weight.consequence import Certainty
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView

_LANGUAGE = "cpp.exception_specification"
_LIBRARY = "cpp.removed_library"
_FLAG = re.compile(r"-std=(?:c|gnu)\+\+(\w+)")
_FEATURE = re.compile(r"cxx_std_(\d+)")
_DRAFTS = {"98": 1998, "03": 2003, "0x": 2011, "1y": 2014, "1z": 2017, "2a": 2020, "2b": 2023}
_REMOVED_IN = 2017


def as_notes_with_older_standard(placed: Mapping[str, Sequence[Hit]], view: PackageView) -> dict[str, list[Hit]]:
    """Return hits by path; what C++17 has not is a note in packages that are built with an older standard.

    Args:
        placed: hits of rules in the files of a package.
        view: the package.
    """
    found = {hit.rule for hits in placed.values() for hit in hits} & {_LANGUAGE, _LIBRARY}
    notes = _rules_of_notes(view) if found else frozenset()
    return {path: [_as_note(hit) if hit.rule in notes else hit for hit in hits] for path, hits in placed.items()}


def _rules_of_notes(view: PackageView) -> Set[str]:
    pinned = list(_pinned(view))
    if pinned and max(pinned) < _REMOVED_IN:
        return {_LANGUAGE, _LIBRARY}
    asks = bool(pinned) or 2 in view.ros or any(year >= _REMOVED_IN for year in _at_least(view))
    return frozenset() if asks else {_LIBRARY}


def _pinned(view: PackageView) -> Iterator[int]:
    """Yield the years of the standards that a package pins; what it asks for at least is none."""
    for one in view.cmake.commands:
        if one.name == "set" and one.words[:1] == ("CMAKE_CXX_STANDARD",):
            yield from map(_year, one.words[1:2])
        if one.name in ("set", "add_definitions", "add_compile_options", "target_compile_options", "string"):
            written = " ".join(argument.written for argument in one.command.arguments)
            yield from (_year(match[1]) for match in _FLAG.finditer(written))


def _at_least(view: PackageView) -> Iterator[int]:
    """Yield the years of the standards that targets of a package ask for at least."""
    for one in view.cmake.named("target_compile_features"):
        yield from (_year(match[1]) for match in map(_FEATURE.fullmatch, one.words) if match is not None)


def _year(written: str) -> int:
    """Return the year of a standard; what is no known one may be the newest."""
    if written in _DRAFTS:
        return _DRAFTS[written]
    return 2000 + int(written) if written.isdigit() else 9999


def _as_note(hit: Hit) -> Hit:
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC)
