"""Rule ``launch.missing_file``: a launch file names a file that its package does not have."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from posixpath import normpath

import msgspec

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.launch.refused.missing_include import found as missing_include
from roslens.source.rules.launch.refused.missing_include import is_written
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.launch_view import LaunchXml
from roslens.source.workspace.elements import Element
from roslens.source.workspace.globs import compiled

_OWN = re.compile(r"\$\(find(?:-pkg-share)?\s+([\w-]+)\)/([^\s$'\"<>|;]+)(?=[\s'\"]|$)")
_SUBMODULE = re.compile(r"^\s*path\s*=\s*(\S+)", re.MULTILINE)
_WRITTEN = re.compile(r"(?i)result|output|save|record|dump|export|write")
"""In names of parameters: the program makes the file."""
_USED = re.compile(r"\$\((?:arg|var)\s+([^\s()]+)\s*\)")
_SHOWN = ".rviz"
"""RViz opens its usual display where the file is not there."""
_FILES = frozenset({"file", "textfile", "binfile", "from", "value", "args", "command", "default"})
_ENDINGS = (
    ".launch",
    ".xml",
    ".yaml",
    ".yml",
    ".rviz",
    ".urdf",
    ".xacro",
    ".py",
    ".pgm",
    ".world",
    ".sdf",
    ".dae",
    ".stl",
)


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each path below the own package that leads nowhere."""
    if _installs_what_it_builds(view):
        return
    told = {(hit.path, hit.line) for hit in missing_include(view)}
    for file in view.launch:
        for hit, path in () if file.is_test else _missing(file, view):
            if (hit.path, hit.line) not in told and not is_written(file.text, path):
                yield hit


def _missing(file: LaunchXml, view: PackageView) -> Iterator[tuple[Hit, str]]:
    names = {path.rpartition("/")[2] for path in view.listing}
    ignored = _ignored(view)
    for element in _used_elements(file):
        for path in _own_paths(element, view):
            if not _is_there(path, names, view) and not (ignored is not None and ignored.fullmatch(path)):
                yield _hit(file, element, path, view), path


def _used_elements(file: LaunchXml) -> Iterator[Element]:
    """Yield the elements of a launch file without arguments that nothing in it uses, and without what never is."""
    used = frozenset(_USED.findall(file.text))
    for element, _ in file.elements:
        is_used = element.tag != "arg" or element.attributes.get("name", "") in used
        if is_used and element.start not in file.left_out:
            yield element


def _hit(file: LaunchXml, element: Element, path: str, view: PackageView) -> Hit:
    hit = file.hit("launch.missing_file", element, _message(path, path.rpartition("/")[2], view), path)
    # Who includes or starts the file may give another than the default.
    is_note = path.endswith(_SHOWN) or (element.tag == "arg" and "default" in element.attributes)
    return msgspec.structs.replace(hit, certainty=Certainty.HEURISTIC) if is_note else hit


def _ignored(view: PackageView) -> re.Pattern[str] | None:
    """Return what matches paths of the package that git ignores: each user has a file of their own there."""
    lines = [line.strip() for name in (".gitignore", view.path(".gitignore")) for line in _lines(view, name)]
    return compiled(line for line in lines if line and not line.startswith(("#", "!")))


def _lines(view: PackageView, path: str) -> list[str]:
    return view.read(path).decode("utf-8", "replace").splitlines()


def _own_paths(element: Element, view: PackageView) -> Iterator[str]:
    """Yield the paths of files below the own package that an element names."""
    if element.tag == "param" and _WRITTEN.search(element.attributes.get("name", "")):
        return
    texts = [value for key, value in element.attributes.items() if key in _FILES]
    for match in (each for text in texts for each in _OWN.finditer(text)):
        if match[1] == view.package.name and _is_meant(match, view):
            yield normpath(match[2])


def _is_meant(match: re.Match[str], view: PackageView) -> bool:
    """Return whether a written path is one of a file that somebody starts the launch file with."""
    # What is left over from ROS 1 in a package for ROS 2 is started by nobody.
    is_left_over = match[0].startswith("$(find ") and 1 not in view.ros
    # What the program fills in: `Object_XXX.xml`.
    return match[2].endswith(_ENDINGS) and not is_left_over and "XXX" not in match[2]


def _is_there(path: str, names: Collection[str], view: PackageView) -> bool:
    """Whether a path of the package leads to a file, or will once it is built; ``names`` are those of its files."""
    if view.exists(view.path(path)) or _is_in_submodule(view.path(path), view):
        return True
    name = path.rpartition("/")[2]
    if 2 in view.ros and name in names:
        return True
    # Builds make files of templates, and install them elsewhere.
    return name in view.cmake.text or f"{name}.in" in names or f"{name}.xacro" in names


def _is_in_submodule(path: str, view: PackageView) -> bool:
    """Return whether a path lies in a repository that a clone without submodules does not have."""
    folder = path
    while folder:
        folder = folder.rpartition("/")[0]
        known = view.read(f"{folder}/.gitmodules" if folder else ".gitmodules").decode("utf-8", "replace")
        inside = path[len(folder) + 1 :] if folder else path
        if any(inside.startswith(f"{one.strip('/')}/") for one in _SUBMODULE.findall(known)):
            return True
    return False


def _installs_what_it_builds(view: PackageView) -> bool:
    """Tell whether a folder that the build fills is installed: what is in it, nobody can see before."""
    for one in view.cmake.named("install"):
        if "DIRECTORY" in one.words and any("BINARY_DIR" in word for word in one.words):
            return True
    return False


def _message(path: str, name: str, view: PackageView) -> str:
    like = sorted(one for one in view.listing if one.rpartition("/")[2] == name)
    advice = f"; {like[0]!r} has that name" if like else ""
    return f"{path!r} does not exist in this package{advice}; expected a file of it"


RULE = PackageRule(
    id="launch.missing_file",
    title="Launch file that names a missing file",
    finds="`$(find PACKAGE)/…` or `$(find-pkg-share PACKAGE)/…` of the own package, with an ending of "
    "configuration, launch, model or map, that leads to no file, is made by no build and is not "
    "ignored by git. Correct the path. Notes are a missing display of RViz, which opens "
    "its usual one, and the default of an argument, of which others may give another value. What "
    "`launch.missing_include` reports is left out, and what the launch file has a program write.",
    why="Launching fails with that file, on the robot, when that branch is first taken.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("launch",),
    bad='<rosparam command="load" file="$(find base_bringup)/params/lidr.yaml"/>',
    good='<rosparam command="load" file="$(find base_bringup)/params/lidar.yaml"/>',
    found=found,
)
