"""Rule ``package.interface_not_generated``: interfaces of a package that setup.py builds: nothing makes code."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule

_ID = "package.interface_not_generated"
_KINDS = ("msg", "srv", "action")


def found(view: PackageView) -> Iterator[Hit]:
    """Yield the first import of interfaces of the package itself, where setup.py builds it."""
    name = view.package.name
    if view.package.build_type != "ament_python" or view.ros != {2}:
        return
    modules = {f"{name}.{kind}" for kind in _KINDS if not _is_written(f"{name}/{kind}", view)}
    for file in sorted(view.by_path.values(), key=lambda one: one.path):
        facts = view.facts.get(file.path)
        for written, line in facts.includes if facts is not None and facts.syntax == "python" else ():
            module = ".".join(written.split(".")[:2])
            if module in modules:
                message = (
                    f"`{module}` is imported, and no interfaces are generated for a package that setup.py builds: a "
                    "ModuleNotFoundError; expected them in a package of ament_cmake with rosidl_generate_interfaces()"
                )
                yield Hit(_ID, message, line, context=module, path=file.path)
                return


def _is_written(module: str, view: PackageView) -> bool:
    """Return whether the package has a module of its own there."""
    return any(one.endswith((f"{module}.py", f"{module}/__init__.py")) for one in view.listing)


RULE = PackageRule(
    id=_ID,
    title="Interfaces that nothing generates",
    finds="A Python source that imports `msg`, `srv` or `action` of its own package, where that is built by setup.py "
    "(`ament_python`) and has no such module. Put the definitions into a package of their own that CMake builds.",
    why="Only rosidl_generate_interfaces() in CMakeLists.txt makes code of definitions: the package builds, and each "
    "program ends at its first line.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2",),
    tags=("interfaces", "build"),
    bad="from arm.srv import Grip  # package.xml of arm: <build_type>ament_python</build_type>",
    good="from arm_interfaces.srv import Grip",
    found=found,
)
