"""Rule ``package.console_script``: an entry point names a module or function that does not exist."""

from __future__ import annotations

from collections.abc import Iterator

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
_NO_MODULES = ("setup.py", "test/", "tests/", "launch/", "docs/")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each console script whose module or function is not there."""
    # CMake does not look at setup.py.
    if view.package.build_type == "ament_cmake" or not _may_install(view) or not view.setup.programs:
        return
    from roslens.source.extract.builds.python_setup_targets import module_file

    folders = dict(view.setup.folders)
    for program in view.setup.programs:
        module, _, function = (part.strip() for part in program.entry.partition(":"))
        path = module_file(view.folder, module, folders, view.by_path)
        if path is not None:
            if not _may_define(path, function, view):
                yield _hit(program.name, f"module {module!r} has no {function!r}", program.evidence)
            continue
        top = module.partition(".")[0]
        own = top == view.package.name and _has_modules(view)
        if own or module_file(view.folder, top, folders, view.by_path):
            yield _hit(program.name, f"module {module!r} does not exist", program.evidence)


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
    finds="A `console_scripts` entry of setup.py whose module is not in the package, or whose module does not "
    "define the function. Correct the entry.",
    why="The program is installed and `ros2 run` finds it, but it ends with an ImportError when the robot starts it.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("python", "install"),
    bad='entry_points={"console_scripts": ["teleop = arm_teleop.teleop_node:mian"]}',
    good='entry_points={"console_scripts": ["teleop = arm_teleop.teleop_node:main"]}',
    found=found,
)
