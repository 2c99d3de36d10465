"""Rule ``package.console_script``: an entry point names a module or function that does not exist."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_SCRIPTS = {
    "setup.py": (b"_scripts",),
    "setup.cfg": (b"_scripts",),
    "pyproject.toml": (b"scripts", b"entry-points"),
}
"""Words without which a file installs no program; what setup.py comes to is dear to find out."""
_UNLIKE = re.compile(r"[^\w.]|^\.|\.\.|\.$")
"""What no name of a module has."""
_NO_MODULES = ("setup.py", "test/", "tests/", "launch/", "docs/")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each console script whose module or function is not there."""
    # CMake does not look at setup.py.
    if view.package.build_type == "ament_cmake" or not _may_install(view) or not view.setup.programs:
        return
    left_out = _left_out(view)
    for program in view.setup.programs:
        what = _mistake(program.entry, view, left_out)
        if what:
            yield _hit(program.name, what, program.evidence)


def _mistake(entry: str, view: PackageView, left_out: str) -> str:
    """Return what is wrong with an entry point; empty where nothing is."""
    from roslens.source.extract.builds.python_setup_targets import module_file

    folders = dict(view.setup.folders)
    module, _, function = (part.strip() for part in entry.partition(":"))
    if _UNLIKE.search(module) or "=" in function:
        return f"{entry!r} is no 'module:function'" + (": a comma is missing before it" if "=" in function else "")
    path = module_file(view.folder, module, folders, view.by_path)
    if path is None:
        top = module.partition(".")[0]
        own = top == view.package.name and _has_modules(view)
        if own or module_file(view.folder, top, folders, view.by_path) or _is_inside(module, view, folders):
            return f"module {module!r} does not exist"
        return ""
    if not _may_define(path, function, view):
        return f"module {module!r} has no {function!r}"
    needed = _needed(function, view.read(path))
    if needed:
        return f"{function!r} of module {module!r} needs an argument {needed!r}, and is called without"
    if left_out and left_out == module.partition(".")[0]:
        return f"package {left_out!r} of its module is not among the `packages` that setup.py installs"
    return ""


def _is_inside(module: str, view: PackageView, folders: Mapping[str, str]) -> bool:
    """Return whether a module without the name of its package is one of the package."""
    from roslens.source.extract.builds.python_setup_targets import module_file

    given = {one.arg for one in view.setup_call.keywords} if view.setup_call is not None else {"py_modules"}
    if {"py_modules", "package_dir", None} & given:
        return False
    return module_file(view.folder, f"{view.package.name}.{module}", dict(folders), view.by_path) is not None


def _needed(function: str, content: bytes) -> str:
    """Return the first argument that a function of a module cannot do without; empty for none."""
    definitions = re.findall(rb"^(?:async )?def %s\(([^()]*)\)" % re.escape(function.encode()), content, re.MULTILINE)
    if len(definitions) != 1 or len(re.findall(rb"\b%s\b\s*=[^=]" % re.escape(function.encode()), content)) > 0:
        return ""
    first = definitions[0].decode("utf-8", "replace").partition(",")[0].strip()
    is_decorated = re.search(rb"^@[^\n]*\n(?:async )?def %s\b" % re.escape(function.encode()), content, re.MULTILINE)
    return "" if not first or "=" in first or first[0] in "*/" or is_decorated else first.partition(":")[0].strip()


def _left_out(view: PackageView) -> str:
    """Return the package of the package's own name, if setup.py installs no package of Python at all."""
    call = view.setup_call
    given = {one.arg: one.value for one in call.keywords} if call is not None else {}
    top = view.package.name
    if {"py_modules", "package_dir", None} & given.keys() or "packages" not in given:
        return ""
    value = given["packages"]
    if isinstance(value, ast.List) and not value.elts:
        return top
    is_found = isinstance(value, ast.Call) and getattr(value.func, "id", "") == "find_packages"
    plain = isinstance(value, ast.Call) and not value.args and all(one.arg == "exclude" for one in value.keywords)
    return top if is_found and plain and f"{top}/__init__.py" not in view.listing else ""


def _may_define(path: str, function: str, view: PackageView) -> bool:
    """Return whether a module may have a function: what is imported or assigned there is one, too."""
    facts = view.facts.get(path)
    if facts is None or facts.faults or not function or "." in function:
        return True
    text = view.read(path)
    return function.encode() in text or b"import *" in text


def _has_modules(view: PackageView) -> bool:
    """Return whether a package has any Python source of its own; where it has none, it is put together elsewhere."""
    return any(path.endswith(".py") and not path.startswith(_NO_MODULES) for path in view.listing)


def _may_install(view: PackageView) -> bool:
    return any(
        word in text
        for name, words in _SCRIPTS.items()
        if name in view.listing and (text := view.read(view.path(name)))
        for word in words
    )


def _hit(name: str, what: str, where: Evidence) -> Hit:
    message = f"console script {name!r}: {what}; expected a function of the package"
    return Hit("package.console_script", message, where.line, context=name, path=where.path)


RULE = PackageRule(
    id="package.console_script",
    title="Entry point that does not exist",
    finds="A `console_scripts` entry of setup.py whose module is not in the package, is named without it or is not "
    "installed, as `packages` is empty or the folder has no `__init__.py`; whose module does not define the function, "
    "or one that needs an argument; and an entry of another form than `module:function`. Correct the entry.",
    why="The program is installed and `ros2 run` finds it, but it ends with an ImportError when the robot starts it.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("python", "install"),
    bad='entry_points={"console_scripts": ["teleop = arm_teleop.teleop_node:mian"]}',
    good='entry_points={"console_scripts": ["teleop = arm_teleop.teleop_node:main"]}',
    found=found,
)
