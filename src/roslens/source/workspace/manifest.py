"""package.xml (REP-127 format 1, REP-140 format 2, REP-149 format 3) as a package, each fact with its place.

What cannot be understood is a failure, and the rest is still known. What is understood and should be said otherwise
is no failure: :mod:`~roslens.source.workspace.mistakes` has it, and rules report it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from posixpath import basename, dirname

import msgspec

from roslens.model.failure import Failure
from roslens.model.source import Dependency, Export, License, Location, Package, Person, Url
from roslens.source.workspace.conditions import ConditionError, evaluate
from roslens.source.workspace.elements import Document, Element, read_elements
from roslens.source.workspace.validity import CONSTRAINTS, DEPENDENCY_TAGS, LOSING, faults_of

MANIFEST_NAME = "package.xml"

MAXIMUM_SIZE = 1 << 20
"""Bytes; the largest manifest known has 12 thousand."""

DEFAULT_BUILD_TYPE = "catkin"
"""The build type of a manifest without one, by REP-149."""

_BUILD_TYPES_OF = {
    "catkin": "catkin",
    "ament_cmake": "ament_cmake",
    "ament_cmake_auto": "ament_cmake",
    "ament_cmake_ros": "ament_cmake",
    "ament_cmake_python": "ament_cmake",
    "ament_python": "ament_python",
    "roscpp": "catkin",
    "rospy": "catkin",
    "rclcpp": "ament_cmake",
    "rosidl_default_generators": "ament_cmake",
    "rclpy": "ament_cmake",
}
"""What a manifest without a build type is written for, by what it depends on; what stands first here decides."""


def read_manifest(
    content: bytes, path: str, environment: Mapping[str, str]
) -> tuple[Package | None, tuple[Failure, ...]]:
    """Read a manifest.

    Args:
        content: of the file.
        path: of the file below the workspace root; the folder in it names a package that has no name.
        environment: variables for the conditions of REP-149.

    Returns:
        The package, or nothing where neither the manifest nor the path tells a name, and what is wrong with the
        manifest. The package's ``id`` is its name and its ``repository`` is empty: the workspace knows them.
    """
    if len(content) > MAXIMUM_SIZE:
        what = f"the manifest is larger than {MAXIMUM_SIZE} bytes"
        failure = _failure(path, what, "a package.xml of some kilobytes", "Check its content.", Location(path))
        return _nameless(path), (failure,)
    reader = _Reader(read_elements(content), path, environment)
    package = reader.package()
    failures = tuple(msgspec.structs.replace(f, package=package.id if package else "") for f in reader.failures)
    return package, failures


def nameless_package(name: str, path: str, manifest: str) -> Package:
    """Return a package of which nothing but its folder is known; ``manifest`` is the path of its package.xml."""
    return Package(id=name, name=name, path=path, manifest=Location(manifest), build_type=DEFAULT_BUILD_TYPE)


def _nameless(path: str) -> Package | None:
    folder = dirname(path)
    return nameless_package(basename(folder), folder, path) if folder else None


def _failure(path: str, what: str, expected: str, advice: str, location: Location) -> Failure:
    return Failure("workspace", what, expected, advice, location, entity=f"file:{path}", partial=True)


class _Reader:
    """Turns elements into the facts of a package and collects what is wrong on the way."""

    def __init__(self, document: Document, path: str, environment: Mapping[str, str]) -> None:
        self.failures: list[Failure] = []
        self._document = document
        self._path = path
        self._environment = environment
        for fault in document.faults:
            line, column = document.place(fault.offset)
            where = Location(path, line, column)
            self.failures.append(_failure(path, fault.what, fault.expected, fault.advice, where))

    def package(self) -> Package | None:
        root = self._document.root
        if root is None or root.tag != "package":
            if root is not None:
                self._fault(root, f'the root is "<{root.tag}>"', "<package>", "Write it as in REP-149.")
            return _nameless(self._path)
        broken = bool(self._document.faults)
        for one in faults_of(root, complete=not broken):
            if one.kind in LOSING:
                self._fault(one.element, one.what, one.expected, one.advice)
        parts: dict[str, list[Element]] = {}
        for element in root.elements():
            parts.setdefault(element.tag, []).append(element)
        return self._assembled(root, parts)

    def _assembled(self, root: Element, parts: dict[str, list[Element]]) -> Package | None:
        name, name_element = _first_text(parts, "name")
        folder = dirname(self._path)
        name = name or basename(folder)
        if not name:
            return None
        exports = tuple(self._export(e) for block in parts.get("export", ()) for e in block.elements())
        dependencies = self._dependencies(e for e in root.elements() if e.tag in DEPENDENCY_TAGS)
        description = " ".join(parts["description"][0].full_text().split()) if "description" in parts else ""
        return Package(
            id=name,
            name=name,
            path=folder or ".",
            manifest=self._location(name_element) if name_element else Location(self._path),
            format=_format(root),
            version=_first_text(parts, "version")[0],
            build_type=self._build_type(exports, dependencies),
            description=description,
            metapackage=any(e.tag == "metapackage" and e.active for e in exports),
            deprecated=next((e.text or "deprecated" for e in exports if e.tag == "deprecated" and e.active), ""),
            dependencies=dependencies,
            member_of_groups=self._dependencies(parts.get("member_of_group", ())),
            maintainers=tuple(self._person(e) for e in parts.get("maintainer", ())),
            authors=tuple(self._person(e) for e in parts.get("author", ())),
            licenses=tuple(
                License(e.text(), e.attributes.get("file", ""), self._location(e)) for e in parts.get("license", ())
            ),
            urls=tuple(
                Url(e.text(), e.attributes.get("type", "website"), self._location(e)) for e in parts.get("url", ())
            ),
            exports=exports,
        )

    def _dependencies(self, elements: Iterable[Element]) -> tuple[Dependency, ...]:
        return tuple(
            Dependency(
                name=name,
                kind=element.tag.removesuffix("_depend"),
                location=self._location(element),
                condition=element.attributes.get("condition", ""),
                active=self._holds(element),
                constraints={key: element.attributes[key] for key in CONSTRAINTS if key in element.attributes},
            )
            for element in elements
            if (name := element.text())
        )

    def _person(self, element: Element) -> Person:
        return Person(element.text(), element.attributes.get("email", ""), self._location(element))

    def _export(self, element: Element) -> Export:
        return Export(
            tag=element.tag,
            location=self._location(element),
            text=element.text(),
            attributes=element.attributes,
            content=element.markup() if element.elements() else "",
            active=self._holds(element),
        )

    def _build_type(self, exports: tuple[Export, ...], dependencies: tuple[Dependency, ...]) -> str:
        active = [export for export in exports if export.tag == "build_type" and export.active]
        if not active:
            # The default is older than ROS 2: many manifests lack one, and their dependencies show ROS 2.
            named = {one.name for one in dependencies if one.active}
            return next((kind for name, kind in _BUILD_TYPES_OF.items() if name in named), DEFAULT_BUILD_TYPE)
        first = active[0]
        if not first.text or first.content:
            advice = f'Write one; "{DEFAULT_BUILD_TYPE}" was taken.'
            expected = "a name like ament_cmake"
            self.failures.append(_failure(self._path, "<build_type> has no name", expected, advice, first.location))
            return DEFAULT_BUILD_TYPE
        if len(active) > 1:
            types = ", ".join(f'"{export.text}"' for export in active)
            advice = f'Give them conditions that exclude each other; "{first.text}" was taken.'
            what = f"{len(active)} build types apply at once, {types}"
            self.failures.append(_failure(self._path, what, "one <build_type>", advice, active[1].location))
        return first.text

    def _holds(self, element: Element) -> bool:
        condition = element.attributes.get("condition")
        if condition is None:
            return True
        try:
            return evaluate(condition, self._environment)
        except ConditionError as error:
            what = f'the condition "{condition[:80]}" of <{element.tag}> cannot be read at "{error.found}"'
            advice = "Correct the condition (REP-149); it was assumed to be true."
            self._fault(element, what, error.expected, advice)
            return True

    def _fault(self, element: Element, what: str, expected: str, advice: str) -> None:
        self.failures.append(_failure(self._path, what, expected, advice, self._location(element)))

    def _location(self, element: Element) -> Location:
        line, column = self._document.place(element.start)
        end_line, end_column = self._document.place(max(element.start, element.end - 1))
        return Location(self._path, line, column, end_line, end_column)


def _first_text(parts: dict[str, list[Element]], tag: str) -> tuple[str, Element | None]:
    elements = parts.get(tag)
    return (elements[0].text(), elements[0]) if elements else ("", None)


def _format(root: Element) -> int:
    text = root.attributes.get("format", "1").strip()
    return int(text) if text in ("1", "2", "3") else 3
