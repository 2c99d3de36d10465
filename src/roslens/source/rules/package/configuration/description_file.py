"""Rule ``package.description_file``: a file that a description of a robot names, and that is not there."""

from __future__ import annotations

import re
from collections.abc import Iterator
from difflib import get_close_matches
from posixpath import dirname, join, normpath

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.elements import Document, Element, read_elements

_ID = "package.description_file"
_OF_PACKAGE = re.compile(r"(?:file://)?\$\(find(?:-pkg-share)? +([\w-]+)\)/([^$]+)|package://([\w-]+)/([^$]+)")
_PLAIN = re.compile(r"[\w./-]+")
_SHAPES = frozenset({"mesh", "texture"})
_NAMING = _SHAPES | {"xacro:include", "include"}
_CONDITIONS = frozenset({"xacro:if", "xacro:unless"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each file of its own package that a description names, and that the package does not have.

    Of several files of a folder that is not there it yields the first: somebody has to fetch or make all of it.
    """
    lacking: set[str] = set()
    for file in view.of_language(Language.URDF, Language.XACRO, roles=(Role.OWN,)):
        content = view.read(file.path)
        if b"filename" not in content:
            continue
        document = read_elements(content)
        for element, conditional in _naming(document):
            name = element.attributes["filename"].strip()
            inside = _inside(name, file.path, view, relative=element.tag not in _SHAPES)
            folder = dirname(inside)
            key = f"{file.path}\0{inside}" if _has(folder, view) else folder
            if inside and key not in lacking and not _is_there(inside, view):
                lacking.add(key)
                place = (file.path, *document.place(element.start))
                yield _hit(element, name, inside, place, view, conditional=conditional)


def _naming(document: Document) -> Iterator[tuple[Element, bool]]:
    """Yield the elements that name a file, each with whether a condition of xacro is around it."""
    waiting = [(document.root, False)] if document.root is not None else []
    while waiting:
        element, conditional = waiting.pop()
        if element.tag in _NAMING and element.attributes.get("filename"):
            yield element, conditional
        below = conditional or element.tag in _CONDITIONS
        waiting.extend((child, below) for child in reversed(element.elements()))


def _is_there(inside: str, view: PackageView) -> bool:
    """Return whether a package has a file at a path, or at one from which its build may install it to that."""
    return view.exists(view.path(inside)) or any(one.endswith(f"/{inside}") for one in view.listing)


def _has(folder: str, view: PackageView) -> bool:
    return not folder or any(one.startswith(f"{folder}/") for one in view.listing)


def _inside(name: str, path: str, view: PackageView, *, relative: bool) -> str:
    """Return a file as a path below the package; empty where it is another's, or a part of it is not known."""
    match = _OF_PACKAGE.fullmatch(name)
    if match is not None:
        package, rest = (match[1], match[2]) if match[1] else (match[3], match[4])
        return normpath(rest) if package == view.package.name and not rest.startswith("/") else ""
    if not relative or name.startswith("/") or not _PLAIN.fullmatch(name):
        return ""
    beside = normpath(join(dirname(view.inside(path)), name))
    return "" if beside.startswith("..") else beside


def _hit(
    element: Element, name: str, inside: str, place: tuple[str, int, int], view: PackageView, *, conditional: bool
) -> Hit:
    path, line, column = place
    last = inside.rpartition("/")[2]
    folder = dirname(inside)
    beside = sorted(one for one in view.listing if dirname(one) == folder)
    near = get_close_matches(inside, beside, 1, 0.6) or [
        one for one in sorted(view.listing) if one.endswith(f"/{last}")
    ]
    meant = f"; there is {near[0]!r}" if near else ""
    include = element.tag not in _SHAPES
    what = "xacro ends there" if include else "nothing is drawn, and no collision is known"
    message = f"<{element.tag}> names {name!r}, which this package does not have: {what}; expected a file that is there"
    # What a build makes or downloads is not in the package; neither is a folder that somebody left out on purpose.
    made = last in view.cmake.text or not _has(folder, view) or conditional
    certainty = Certainty.HEURISTIC if made else None
    return Hit(
        _ID, f"{message}{meant}", line, column, context=name, path=path, certainty=certainty,
        consequence=None if include else Consequence.MAY_BE_WRONG,
    )  # fmt: skip


RULE = PackageRule(
    id=_ID,
    title="File of a description that is not there",
    finds="A `<xacro:include>`, `<mesh>` or `<texture>` in a description of a robot (URDF, xacro) that names a file "
    "of its own package (`$(find …)`, `package://`, for includes also beside the file) which the package does not "
    "have. A file that CMakeLists.txt mentions, of a folder that is not there, or below a condition of xacro is a "
    "note.",
    why="xacro ends with «No such file or directory», so that no description is published and nothing that needs it "
    "starts; without a mesh a part of the robot is not drawn, or has no collision.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("configuration", "description"),
    bad='<robot xmlns:xacro="http://ros.org/wiki/xacro" name="rover">\n'
    '  <xacro:include filename="$(find rover)/urdf/wheels.xacro"/>\n</robot>',
    good='<robot xmlns:xacro="http://ros.org/wiki/xacro" name="rover">\n'
    '  <xacro:include filename="$(find rover)/urdf/wheel.xacro"/>\n</robot>',
    found=found,
)
