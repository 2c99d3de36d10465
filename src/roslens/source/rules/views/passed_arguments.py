"""What a launch file of ROS 1 gets from outside: of files that include it, and on command lines that are written."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property
from posixpath import basename
from typing import TYPE_CHECKING

from roslens.source.rules.views.launch_view import LaunchXml, launch_files
from roslens.source.rules.views.package_files import PackageFiles
from roslens.source.workspace.command_texts import command_texts

if TYPE_CHECKING:
    from roslens.source.workspace.elements import Element

_FIND = re.compile(r"\$\(find\s+([\w-]+)\s*\)/")
_SUBSTITUTION = re.compile(r"\$\([^()]*\)")
_GOES_ON = re.compile(rb"\\\r?\n")


def declared_in(file: LaunchXml) -> Iterator[str]:
    """Yield the names of the arguments that a launch file declares."""
    for element, around in file.elements:
        if element.tag == "arg" and around != "include":
            yield element.attributes.get("name", "")


class Passing:
    """What is passed to the launch files of a package."""

    def __init__(self, package: PackageFiles) -> None:
        """Take a package; nothing is read before it is asked for."""
        self._package = package

    def is_passed(self, file: LaunchXml, name: str) -> bool:
        """Return whether others include a file, and all of them pass an argument on.

        They do so with all that they have, or by its name where the file declares it, if too late.
        """
        path = self._package.inside(file.path)
        is_declared = name in declared_in(file)
        by = [pair for pair in self._includes if pair[0].path != file.path and self._leads_to(pair[1], path)]
        return bool(by) and all(
            _passes(one, element, name) or (is_declared and name in _given(element)) for one, element in by
        )

    def is_included(self, file: LaunchXml) -> bool:
        """Return whether another launch file includes a file."""
        path = self._package.inside(file.path)
        return any(one.path != file.path and self._leads_to(element, path) for one, element in self._includes)

    def is_on_a_command_line(self, file: LaunchXml, name: str) -> bool:
        """Return whether a script or a text gives an argument to a file, or to another of its package, by that name."""
        package = self._package.package.name
        started = b"|".join(re.escape(one.encode()) for one in (basename(file.path), package))
        pattern = rb"\b(?:%s)\b[^\n]*[\s\"'`]%s:=" % (started, re.escape(name.encode()))
        return any(re.search(pattern, text) for text in self._texts)

    @cached_property
    def _includes(self) -> list[tuple[LaunchXml, Element]]:
        """Elements that include a file, with the one they stand in, of the package and of those that ask for it."""
        package = self._package
        others = (LaunchXml(package, file.path, is_test=False) for file in package.around.launched_by)
        files = (*launch_files(package), *others)
        return [(one, element) for one in files for element, _ in one.elements if element.tag == "include"]

    @cached_property
    def _texts(self) -> list[bytes]:
        """Texts and scripts of the package, and those beside it and above, with continued lines joined."""
        package = self._package
        inside = (package.path(one) for one in package.listing)
        paths = command_texts(package.root, package.folder, inside)
        return [_GOES_ON.sub(b" ", package.read(path)) for path in paths]

    def _leads_to(self, element: Element, path: str) -> bool:
        """Return whether an include is of a path below the package; where a folder is open, its name decides."""
        file = element.attributes.get("file", "")
        if match := _FIND.match(file):
            return match[1] == self._package.package.name and _may_be(file[match.end() :].lstrip("/"), path)
        return _may_be(basename(file), basename(path))


def _may_be(written: str, path: str) -> bool:
    """Return whether a path with substitutions may be another."""
    pattern = ".*".join(map(re.escape, _SUBSTITUTION.split(written)))
    return re.fullmatch(pattern, path) is not None


def _passes(file: LaunchXml, include: Element, name: str) -> bool:
    if include.attributes.get("pass_all_args", "").strip().lower() not in ("true", "1"):
        return False
    return name in _given(include) or name in declared_in(file)


def _given(include: Element) -> Iterator[str]:
    """Yield the names of the arguments that an include gives."""
    return (one.attributes.get("name", "") for one in include.elements() if one.tag == "arg")
