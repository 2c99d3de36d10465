"""Rule ``package.subpackage_missing``: a Python package inside of the package's own that setup.py does not install."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each folder of modules that an installed module imports and the list of packages leaves out."""
    call = view.setup_call
    if view.package.build_type != "ament_python" or call is None:
        return
    given = {one.arg: one.value for one in call.keywords}
    listed = _listed(given.get("packages"), view)
    if not listed or "package_dir" in given or None in given:
        return
    line = given["packages"].lineno
    for name in sorted(_imported(view) - listed):
        top = name.partition(".")[0]
        folder = name.replace(".", "/")
        if top in listed and any(one.startswith(f"{folder}/") and one.endswith(".py") for one in view.listing):
            message = f"package {name!r} is imported and not installed; expected it in `packages`, or find_packages()"
            yield Hit("package.subpackage_missing", message, line, context=name, path=view.path("setup.py"))


def _listed(value: ast.expr | None, view: PackageView) -> frozenset[str]:
    """Return the packages of a list of names; nothing where one of them is not known."""
    if not isinstance(value, (ast.List, ast.Tuple)):
        return frozenset()
    found = set()
    for one in value.elts:
        if isinstance(one, ast.Constant) and isinstance(one.value, str):
            found.add(one.value)
        elif isinstance(one, ast.Name) and (name := _assigned(one.id, view)):
            found.add(name)
        else:
            return frozenset()
    return frozenset(found)


def _assigned(name: str, view: PackageView) -> str:
    values = [
        one.value.value
        for one in (view.setup_tree.body if view.setup_tree is not None else ())
        if isinstance(one, ast.Assign)
        and [getattr(each, "id", "") for each in one.targets] == [name]
        and isinstance(one.value, ast.Constant)
    ]
    return values[0] if len(values) == 1 and isinstance(values[0], str) else ""


def _imported(view: PackageView) -> set[str]:
    """Return the packages below those of the package that its modules import, with all around them."""
    found: set[str] = set()
    for path, facts in view.facts.items():
        inside = view.inside(path)
        if facts.syntax != "python" or "test" in inside or "/" not in inside or inside.startswith("launch/"):
            continue
        around = inside.rpartition("/")[0].replace("/", ".")
        for written, _ in facts.includes:
            name = _absolute(written, around)
            while name:
                if f"{name.replace('.', '/')}/__init__.py" in view.listing or _is_folder(name, view):
                    found.add(name)
                name = name.rpartition(".")[0]
    return {one for one in found if "." in one}


def _absolute(written: str, around: str) -> str:
    dots = len(written) - len(written.lstrip("."))
    if not dots:
        return written
    parts = around.split(".")
    base = parts[: len(parts) - dots + 1]
    return ".".join((*base, written.lstrip("."))).strip(".")


def _is_folder(name: str, view: PackageView) -> bool:
    prefix = f"{name.replace('.', '/')}/"
    return any(one.startswith(prefix) and one.endswith(".py") for one in view.listing)


RULE = PackageRule(
    id="package.subpackage_missing",
    title="Python package that setup.py does not install",
    finds="A folder of modules inside of the Python package of an `ament_python` package that a module of it imports, "
    "and that the list `packages` of setup.py, written out by names, leaves out. `find_packages()` lists all that have "
    "an `__init__.py`.",
    why="From the source folder the import works; once installed, the program ends with a ModuleNotFoundError.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("python", "install"),
    bad="setup(name='arm', packages=['arm'])  # and arm/driver.py imports arm.util",
    good="setup(name='arm', packages=['arm', 'arm.util'])",
    found=found,
)
