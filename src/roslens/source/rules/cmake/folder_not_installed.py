"""Rule ``cmake.folder_not_installed``: launch files and configuration that stay in the source folder."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.plural import plural
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.renamed_package import name_here

_FOLDERS = (
    "launch",
    "config",
    "params",
    "param",
    "urdf",
    "xacro",
    "meshes",
    "rviz",
    "worlds",
    "maps",
    "models",
    "behavior_trees",
)
_COMMENT = re.compile(r"(?m)#[^\n]*")
_READERS = (
    Language.LAUNCH_XML,
    Language.LAUNCH_YAML,
    Language.LAUNCH_PYTHON,
    Language.PYTHON,
    Language.CPP,
    Language.C,
)


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each folder of files for running that nothing installs."""
    files = [file.path for file in view.files if file.role is Role.OWN]
    build = _build(view)
    if build is None:
        return
    text, place = build
    for folder in _FOLDERS:
        inside = [path for path in files if view.inside(path).startswith(f"{folder}/")]
        inside = [path for path in inside if not path.endswith(("CMakeLists.txt", "__init__.py"))]
        named = re.search(rf"(?<![\w-]){folder}(?![\w-])", text)
        if not inside or (named and not _matches_nothing(folder, view)):
            continue
        if _is_asked_for(folder, inside, view):
            # Configuration that is only named may be left over; whoever starts a launch file needs it.
            sure = folder == "launch" and 2 in view.ros
            yield Hit(
                "cmake.folder_not_installed",
                _message(folder, plural(len(inside), "file"), matches_none=bool(named)),
                _installing(folder, view) or place[1],
                context=folder,
                path=place[0],
                certainty=None if sure else Certainty.HEURISTIC,
            )


def _message(folder: str, amount: str, *, matches_none: bool) -> str:
    if matches_none:
        return f"no file of folder {folder!r} ({amount}) is installed: what setup.py looks for matches none"
    return f"folder {folder!r} ({amount}) is installed by nothing; expected a rule that installs it"


def _matches_nothing(folder: str, view: PackageView) -> bool:
    """Return whether setup.py, all of which is known, installs to a folder of that name, and nothing that is there."""
    setup = view.setup
    if view.package.build_type != "ament_python" or setup.unresolved:
        return False
    places = [files for place, files in setup.data if place.rstrip("/").endswith(f"/{folder}")]
    installed = {view.inside(path) for _, files in setup.data for path in files}
    return bool(places) and not any(places) and not any(path.startswith(f"{folder}/") for path in installed)


def _installing(folder: str, view: PackageView) -> int:
    """Return the line of the item of ``data_files`` that names a folder and looks for files; 0 where none does."""
    call = view.setup_call if view.package.build_type == "ament_python" else None
    items = [
        item
        for keyword in (call.keywords if call is not None else ())
        if keyword.arg == "data_files"
        for item in ast.walk(keyword.value)
        if isinstance(item, ast.Tuple) and len(item.elts) == 2
    ]
    for item in items:
        words = [one.value for one in ast.walk(item.elts[0]) if isinstance(one, ast.Constant)]
        if any(isinstance(one, str) and folder in one.split("/") for one in words):
            return item.lineno
    return 0


def _is_asked_for(folder: str, inside: list[str], view: PackageView) -> bool:
    """Return whether somebody looks for the folder: ``ros2 launch``, or a file of the package that names it."""
    if folder == "launch":
        gone = [use.name.encode() for use in view.uses if use.how.startswith("launch") and name_here(use.name, view)]
        texts = (view.read(path) for path in inside if "launch" in path.rpartition("/")[2])
        return any(not any(name in text for name in gone) for text in texts)
    readers = view.of_language(*_READERS, roles=(Role.OWN,))
    texts = (view.read(one.path) for one in readers if one.path not in inside)
    named = re.compile(rf"['\"/(\s]{folder}['\"/]".encode())
    return any(named.search(text) for text in texts)


def _build(view: PackageView) -> tuple[str, tuple[str, int]] | None:
    """Return what installs, and where a hit is placed; nothing where that is open."""
    if view.package.build_type == "ament_python":
        text = _COMMENT.sub("", view.read(view.path("setup.py")).decode("utf-8", "replace"))
        if view.setup_call is None or "os.walk" in text or "rglob" in text or "**" in text or "listdir" in text:
            return None
        return text, (view.path("setup.py"), view.setup_call.lineno)
    ends = view.cmake.first("ament_package", "ament_auto_package", "catkin_package", "autoware_package")
    if ends is None:
        return None
    text = _COMMENT.sub("", view.cmake.text)
    if re.search(r"DIRECTORY\s+(?:\.|\$\{\w+_SOURCE_DIR\})/?\s", text) or "GLOB" in text:
        return None
    return text, (ends.path, ends.command.line)


RULE = PackageRule(
    id="cmake.folder_not_installed",
    title="Folder for running that nothing installs",
    finds="A folder `launch`, `config`, `params`, `urdf`, `meshes`, `rviz`, `worlds`, `maps` or the like whose "
    "name stands nowhere in CMakeLists.txt (or in the setup.py of an `ament_python` package) but in comments, or from "
    "which the patterns of setup.py match no file, and which a launch "
    "file or source of the package names; `launch` itself needs no one to name it, but a file that names no package "
    "under a name that it has no more. Install it to `share/PACKAGE`. "
    "In ROS 1, where the devel space finds it, it is a note, and so are other folders than `launch`, which may be left "
    "over.",
    why="`ros2 launch` and `$(find-pkg-share …)` look into the installation: the file is not found there, or on "
    "the robot only, where nothing but the installation is.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("build", "install"),
    bad="ament_package()  # and a folder launch/",
    good="install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\nament_package()",
    found=found,
)
