"""Rule ``package.missing_python_package``: setup.py installs a package of Python whose folder is not there."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_CALLS = ("setup", "generate_distutils_setup")
_MAKES = ("parameter_library", "generate_parameter_module", "build_ext", "cmdclass", "makedirs", "mkdir")
"""What stands in a setup.py that may make folders."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each package that ``packages=[…]`` names and that has no folder."""
    tree = view.setup_tree
    if tree is None or not _is_used(view):
        return
    text = view.read(view.path("setup.py"))
    if any(one.encode() in text for one in _MAKES):
        return
    names = _constants(tree)
    for call in (one for one in ast.walk(tree) if isinstance(one, ast.Call)):
        if getattr(call.func, "id", getattr(call.func, "attr", "")) in _CALLS:
            yield from _missing(call, names, view)


def _is_used(view: PackageView) -> bool:
    """Return whether the build runs setup.py."""
    return view.package.build_type == "ament_python" or view.cmake.first("catkin_python_setup") is not None


def _constants(tree: ast.Module) -> Mapping[str, str]:
    """Return the texts of the names that the file sets once."""
    found: dict[str, list[str]] = {}
    for one in ast.walk(tree):
        if isinstance(one, ast.Assign) and len(one.targets) == 1 and isinstance(one.targets[0], ast.Name):
            value = one.value.value if isinstance(one.value, ast.Constant) else None
            found.setdefault(one.targets[0].id, []).append(value if isinstance(value, str) else "")
    return {name: values[0] for name, values in found.items() if len(values) == 1 and values[0]}


def _text(node: ast.expr | None, names: Mapping[str, str]) -> str | None:
    """Return the text of an expression; None where it is not known."""
    match node:
        case ast.Constant(value=str(value)):
            return value
        case ast.Name(id=name):
            return names.get(name)
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            parts = (_text(left, names), _text(right, names))
            return None if parts[0] is None or parts[1] is None else parts[0] + parts[1]
        case ast.JoinedStr(values=values):
            texts = [_text(one.value if isinstance(one, ast.FormattedValue) else one, names) for one in values]
            return None if None in texts else "".join(one for one in texts if one)
    return None


def _missing(call: ast.Call, names: Mapping[str, str], view: PackageView) -> Iterator[Hit]:
    given = {one.arg: one.value for one in call.keywords}
    listed, folders = given.get("packages"), _folders(given.get("package_dir"), names)
    if not isinstance(listed, ast.List | ast.Tuple) or folders is None:
        return
    for one in listed.elts:
        name = _text(one, names)
        folder = _folder(name, folders) if name else "."
        if name is None or view.exists(view.path(folder)) or ".." in folder:
            continue
        # catkin reads the folder in the installation only: who never installs does not notice.
        sure = view.package.build_type == "ament_python"
        message = f"package {name!r} of `packages` has no folder {folder!r}; expected the folder, or another name"
        yield Hit(
            "package.missing_python_package",
            message,
            one.lineno,
            one.col_offset + 1,
            context=name,
            path=view.path("setup.py"),
            certainty=None if sure else Certainty.HEURISTIC,
        )


def _folders(node: ast.expr | None, names: Mapping[str, str]) -> Mapping[str, str] | None:
    """Return where packages lie, by name; None where that is not known."""
    if node is None:
        return {}
    if not isinstance(node, ast.Dict):
        return None
    pairs = [(_text(key, names), _text(value, names)) for key, value in zip(node.keys, node.values, strict=True)]
    known = {key: value for key, value in pairs if key is not None and value is not None}
    return known if len(known) == len(pairs) else None


def _folder(name: str, folders: Mapping[str, str]) -> str:
    """Return the folder of a package, as setuptools looks for it."""
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        base = folders.get(".".join(parts[:length]))
        if base is not None:
            return "/".join(filter(None, (base.strip("/"), *parts[length:])))
    return "/".join(filter(None, (folders.get("", "").strip("/"), *parts)))


RULE = PackageRule(
    id="package.missing_python_package",
    title="Package of Python that setup.py names and that is not there",
    finds="A name in `packages=[…]` of setup.py, of an `ament_python` package or one that calls `catkin_python_setup`, "
    "whose folder, by `package_dir`, does not exist. Lists that are computed, and a setup.py that makes folders, are "
    "left out. In ROS 1, where only an installation needs the folder, it is a note.",
    why="setuptools stops the build («package directory … does not exist»).",
    consequence=Consequence.STOPS_BUILD,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("python", "build"),
    bad="setup(name='arm_teleop', packages=['arm_telop'])",
    good="setup(name='arm_teleop', packages=['arm_teleop'])",
    found=found,
)
