"""Where a package uses others: in its build, its includes and its imports."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from posixpath import dirname

import msgspec

from roslens.model.source import Language, Role, SourceFile
from roslens.source.rules.system_packages import is_ros_package
from roslens.source.rules.views.cmake_view import CmakeView, Written
from roslens.source.rules.views.launch_view import LaunchXml
from roslens.source.rules.views.library_uses import libraries_of
from roslens.source.rules.views.package_files import PackageFiles
from roslens.source.rules.views.plugin_uses import plugins_named
from roslens.source.syntax.facts import FileFacts
from roslens.source.workspace.elements import Element

_FOUND = re.compile(r"\$\(find(?:-pkg-share|-pkg-prefix)?\s+([\w-]+)\)")
_FOUND_IN_PYTHON = re.compile(
    r"(?:get_package_share_directory|FindPackageShare|get_package_share_path)\(\s*(?:package\s*=\s*)?['\"]([\w-]+)['\"]"
    r"|\bpackage\s*=\s*['\"]([\w-]+)['\"]"
)

MOST_USES = 1_000
"""Of a package; one that uses more is made by a program."""
BUILD, RUN, TEST = "build", "run", "test"
_WHEN = {"cpp": BUILD}
"""When sources of a syntax need what they name, where that is not when they run."""
"""When it is used."""

_AFTER_COMPONENTS = frozenset({"OPTIONAL_COMPONENTS", "REQUIRED", "QUIET", "NO_MODULE", "CONFIG", "EXACT", "MODULE"})
_AROUND = re.compile(r"(?:^|/)(?:examples?|demos?|docs?|ros_lib|templates?)(?:/|$)")
"""Folders of code that the package carries and does not build for itself."""


class Use(msgspec.Struct, frozen=True):
    """A place where another package is used.

    Attributes:
        name: as used.
        when: :data:`BUILD`, :data:`RUN` or :data:`TEST`.
        how: as a message says it.
        path: below the workspace.
        line: 1-based.
        required: whether it cannot do without.
        files: how many files of the package use it, in whatever way and at whatever time.
    """

    name: str
    when: str
    how: str
    path: str
    line: int
    required: bool = True
    files: int = 1


def uses_of(view: PackageFiles, cmake: CmakeView, launch: Sequence[LaunchXml]) -> tuple[Use, ...]:
    """Return where a package uses others, those in the build first; one for each package, way and time."""
    found: dict[tuple[str, str, bool], Use] = {}
    files: dict[str, set[str]] = {}
    for use in (*_of_build(cmake), *_of_sources(view), *_of_launch(view, launch), *_by_name(view)):
        found.setdefault((use.name, use.when, use.how.startswith("find")), use)
        files.setdefault(use.name, set()).add(use.path)
        if len(found) >= MOST_USES:
            break
    including = _including(view)
    return tuple(
        msgspec.structs.replace(use, files=len(files[use.name] | including.get(_plain(use.name), set())))
        for use in found.values()
    )


def _including(view: PackageFiles) -> dict[str, set[str]]:
    """Return the sources that include headers below a folder, by its name as :func:`_plain` writes it."""
    found: dict[str, set[str]] = {}
    for path, facts in view.facts.items():
        for written, _ in facts.includes if facts.syntax == "cpp" else ():
            found.setdefault(_plain(_included(written)), set()).add(path)
    return found


def _plain(name: str) -> str:
    """Return a name as libraries and the folders of their headers have it in common: ``Eigen3`` and ``Eigen``."""
    return name.lower().rstrip("0123456789").replace("-", "_")


def _of_build(cmake: CmakeView) -> Iterator[Use]:
    for one in cmake.named("find_package"):
        if not one.words or one.defined:
            continue
        when = TEST if one.for_tests else BUILD
        # In a condition it may be for the other ROS, or another system.
        required = "REQUIRED" in one.words and not (one.conditions and when == BUILD)
        for name, how in _found_by(one):
            yield Use(name, when, how, one.path, one.command.line, required)


def _found_by(one: Written) -> Iterator[tuple[str, str]]:
    """Yield the packages that a ``find_package`` looks for, each with how that is written."""
    name, *rest = one.words
    if name != "catkin":
        if "$" not in name:
            yield name, f"find_package({name})"
        return
    for part in rest[rest.index("COMPONENTS") + 1 :] if "COMPONENTS" in rest else ():
        if part not in _AFTER_COMPONENTS and "$" not in part:
            yield part, f"find_package(catkin COMPONENTS {part})"


def _of_sources(view: PackageFiles) -> Iterator[Use]:
    own = {view.package.name, *(one.partition("/")[0] for one in view.listing if "/" in one)}
    # Headers that the package carries below a folder of another's name.
    parts = [one.split("/") for one in view.listing if one.endswith((".h", ".hpp", ".hh"))]
    copies = {"/".join(one[-depth:]) for one in parts for depth in (2, 3)}
    for file in view.files:
        facts = view.facts.get(file.path)
        if facts is None or file.role not in (Role.OWN, Role.TEST):
            continue
        folder = view.inside(dirname(file.path))
        if _AROUND.search(folder):
            continue
        is_test = file.role is Role.TEST or "test" in folder
        when = TEST if is_test else _WHEN.get(facts.syntax, RUN)
        for name, how, line in _asked_for(file, facts, copies):
            if name and name not in own and is_ros_package(name):
                yield Use(name, when, how, file.path, line)


def _asked_for(file: SourceFile, facts: FileFacts, copies: Collection[str]) -> Iterator[tuple[str, str, int]]:
    """Yield what a source includes or imports: the first part of its name, how that is written, and the line."""
    if facts.syntax == "cpp":
        for written, line in facts.includes:
            if written.strip('<>"') not in copies:
                yield _included(written), f"#include {written}", line
    elif file.language is not Language.LAUNCH_PYTHON:
        for written, line in facts.includes:
            yield written.partition(".")[0], f"import {written}", line


def _of_launch(view: PackageFiles, launch: Sequence[LaunchXml]) -> Iterator[Use]:
    for file in launch:
        # A launch file of ROS 1 that was left in a package for ROS 2 is not used.
        left = view.ros == {2} and any(one.tag == "node" and "type" in one.attributes for one, _ in file.elements)
        if left or file.is_test or _AROUND.search(view.inside(dirname(file.path))):
            continue
        for element, _ in file.elements:
            for name in filter(_is_literal, _named_by(element)):
                yield Use(name, RUN, f"launch file {view.inside(file.path)}", file.path, file.line(element))
    yield from _of_launch_python(view)


def _by_name(view: PackageFiles) -> Iterator[Use]:
    """Yield what nothing of ROS is told by: plug-ins that parameters name, and libraries that sources import."""
    for module, key, path, line in libraries_of(view):
        yield Use(key, RUN, f"library {module}", path, line)
    for name, written, path, line in plugins_named(view):
        yield Use(name, RUN, f"plug-in {written}", path, line)


def _named_by(element: Element) -> list[str]:
    """Return the packages that an element of a launch file names."""
    names = [name for value in element.attributes.values() for name in _FOUND.findall(value)]
    if element.tag in ("node", "composable_node"):
        names.append(element.attributes.get("pkg", ""))
    return names


def _of_launch_python(view: PackageFiles) -> Iterator[Use]:
    for one in view.of_language(Language.LAUNCH_PYTHON, roles=(Role.OWN,)):
        if _AROUND.search(view.inside(dirname(one.path))) or "test" in view.inside(one.path):
            continue
        text = view.read(one.path).decode("utf-8", "replace")
        for match in _FOUND_IN_PYTHON.finditer(text):
            line, name = text.count("\n", 0, match.start()) + 1, match[1] or match[2]
            if "#" not in text[text.rfind("\n", 0, match.start()) + 1 : match.start()] and _is_literal(name):
                yield Use(name, RUN, f"launch file {view.inside(one.path)}", one.path, line)


def _is_literal(name: str) -> bool:
    return re.fullmatch(r"[A-Za-z][\w-]*", name) is not None


def _included(written: str) -> str:
    path = written.strip('<>"')
    name, _, rest = path.partition("/")
    return name if rest else ""
