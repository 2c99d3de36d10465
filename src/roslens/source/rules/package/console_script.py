"""Rule ``package.console_script``: an entry point names a module or function that does not exist."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.finding import Severity
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


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each console script whose module or function is not there."""
    if not _may_install(view) or not view.setup.programs:
        return
    from roslens.source.extract.builds.python_setup_targets import module_file

    folders = dict(view.setup.folders)
    for program in view.setup.programs:
        module, _, function = (part.strip() for part in program.entry.partition(":"))
        path = module_file(view.folder, module, folders, view.by_path)
        if path is None:
            top = module.partition(".")[0]
            if module_file(view.folder, top, folders, view.by_path) or top == view.package.name:
                yield _hit(program.name, f"module {module!r} does not exist", program.evidence)
            continue
        facts = view.facts.get(path)
        if facts is None or facts.faults or not function or "." in function:
            continue
        # It may be imported or assigned there.
        text = view.read(path)
        if function.encode() not in text and b"import *" not in text:
            yield _hit(program.name, f"module {module!r} has no {function!r}", program.evidence)


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
    severity=Severity.ERROR,
    profiles=("ros2", "ros1"),
    tags=("python", "install"),
    bad='entry_points={"console_scripts": ["teleop = arm_teleop.teleop_node:mian"]}',
    good='entry_points={"console_scripts": ["teleop = arm_teleop.teleop_node:main"]}',
    found=found,
)
