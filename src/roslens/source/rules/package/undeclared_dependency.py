"""Rule ``package.undeclared_dependency``: the package uses one that its manifest does not declare."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roslens.model.edit import Edit
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.edits.manifest_edits import joined
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.system_packages import (
    KEY_OF,
    KEYS,
    NEEDS_NO_KEY,
    brings,
    is_ros_package,
    looks_like_ros_package,
    stands_for,
)
from roslens.source.rules.views.dependency_uses import BUILD, RUN, TEST, Use
from roslens.source.rules.views.library_uses import LIBRARIES

_WHAT = {
    "#include": "headers are included of packages",
    "import": "modules are imported of packages",
    "launch": "launch files need packages",
    "library": "libraries are imported",
    "plug-in": "plug-ins are named of packages",
}
_TAGS_OF_FORMAT_1 = {BUILD: ("build_depend", "run_depend"), RUN: ("run_depend",), TEST: ("test_depend",)}
_TAGS_OF_FORMAT_2 = {BUILD: ("depend",), RUN: ("exec_depend",), TEST: ("test_depend",)}
_TAGS = {BUILD: "<depend>", RUN: "<exec_depend>", TEST: "<test_depend>"}


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each package that is found and not declared, and at once those that are included, or imported."""
    declared = {one.name for one in (*view.package.dependencies, *view.package.member_of_groups)}
    reported: set[str] = set()
    gathered: dict[str, dict[str, Use]] = {how: {} for how in _WHAT}
    for use in view.uses:
        if use.name in reported or not _expected(use, view) or any(_is_said(key, use) for key in declared):
            continue
        reported.add(use.name)
        if _closes_cycle(use, view):
            yield _cyclic(use, view)
            continue
        how = use.how.partition(" ")[0]
        if how in gathered:
            gathered[how][use.name] = use
            continue
        message = f"{use.how}: package.xml does not declare {use.name!r}; expected {_tag(use)}"
        edits = _declared((use,), view)
        yield Hit("package.undeclared_dependency", message, use.line, context=use.name, path=use.path, edits=edits)
    for how, uses in gathered.items():
        if uses:
            yield _together(how, list(uses.values()), view)


def _together(how: str, uses: list[Use], view: PackageView) -> Hit:
    first = uses[0]
    names = ", ".join(_named(use) for use in uses)
    tags = " and ".join(dict.fromkeys(_TAGS[use.when] for use in uses))
    message = f"{_WHAT[how]} that package.xml does not declare: {names}; expected {tags}"
    # What is included was found in the build: another dependency brings it.
    is_brought = how == "#include" or (
        how in ("plug-in", "library") and all(_is_said_elsewhere(use, view) for use in uses)
    )
    certainty = Certainty.HEURISTIC if is_brought else None
    return Hit(
        "package.undeclared_dependency",
        message,
        first.line,
        context=how,
        path=first.path,
        certainty=certainty,
        edits=_declared(uses, view),
    )


def _is_said_elsewhere(use: Use, view: PackageView) -> bool:
    """Return whether another package of the workspace declares it: it is installed with that one."""
    return any(_is_said(key, use) for key in view.around.declared)


def _tag(use: Use) -> str:
    """Return what is expected in package.xml, with the key where the name is none itself."""
    tag = _TAGS[use.when]
    return f"{tag}{KEY_OF[use.name]}{tag.replace('<', '</')}" if use.name in KEY_OF else tag


def _closes_cycle(use: Use, view: PackageView) -> bool:
    """Return whether no build could order the packages any more with the dependency declared."""
    way = dict(view.around.dependents).get(use.name)
    return way is not None and (way or use.when != RUN or 2 in view.ros)


def _cyclic(use: Use, view: PackageView) -> Hit:
    own, other = view.package.name, use.name
    through = "" if other in view.around.asked_by else ", through other packages"
    message = (
        f"{use.how}: {own!r} uses {other!r} without declaring it, and package.xml of {other!r} declares "
        f"{own!r}{through}: the two depend on each other, and no build can order them with both declared; expected "
        "that one does without the other, or a package of its own for what needs both"
    )
    certainty = Certainty.HEURISTIC
    return Hit("package.undeclared_dependency", message, use.line, context=other, path=use.path, certainty=certainty)


def _declared(uses: Sequence[Use], view: PackageView) -> tuple[Edit, ...]:
    """Return what declares all of some packages; nothing where the key of one, or its condition, is not certain."""
    manifest = view.manifest_edits
    known = all(
        is_ros_package(use.name) or use.name in KEY_OF or use.how.startswith(("plug-in", "library")) for use in uses
    )
    if not manifest.format or len(view.ros) > 1 or not known:
        return ()
    tags = _TAGS_OF_FORMAT_1 if manifest.format == 1 else _TAGS_OF_FORMAT_2
    return joined([manifest.added(tag, KEY_OF.get(use.name, use.name)) for use in uses for tag in tags[use.when]])


def _named(use: Use) -> str:
    """Return a package as messages name it; a library by its module too."""
    how, _, module = use.how.partition(" ")
    return f"{module!r} by the key {use.name!r}" if how == "library" else repr(use.name)


def _is_said(key: str, use: Use) -> bool:
    how, _, module = use.how.partition(" ")
    if how == "library":
        return any(sign in key.lower() for sign in LIBRARIES[module].signs)
    # What is built needs the package itself, because CMake looks for it.
    return stands_for(key, use.name) or (use.when == RUN and brings(key, use.name))


def _expected(use: Use, view: PackageView) -> bool:
    name = use.name
    if not use.required or name in NEEDS_NO_KEY or name == view.package.name:
        return False
    if use.how.startswith("import") and _is_own_module(name, view):
        return False
    if any(one.endswith((f"Find{name}.cmake", f"{name}-config.cmake", f"{name}Config.cmake")) for one in view.listing):
        return False
    if name.startswith("ament_cmake"):
        return use.when == TEST and name.removeprefix("ament_cmake_") in ("gtest", "gmock", "pytest")
    return use.how.startswith(("launch", "plug-in", "library")) or name in KEYS or looks_like_ros_package(name)


def _is_own_module(name: str, view: PackageView) -> bool:
    """Return whether the package has a module of a name, wherever: ``sys.path`` may have its folder."""
    ends = (f"/{name}.py", f"/{name}/__init__.py")
    return any(one.endswith(ends) for one in view.listing)


RULE = PackageRule(
    id="package.undeclared_dependency",
    title="Package used and not declared",
    finds="A package that CMakeLists.txt finds, that a launch file finds or starts nodes of, that has a plug-in which "
    "parameters name (controllers of ros2_control, plug-ins of Nav2 and MoveIt), or, of ROS, that sources include or "
    "import, and of which package.xml says nothing; also libraries of Python that only rosdep installs, such as "
    "pyserial, where no list for pip or image installs them. What is imported is one finding for a package, what "
    "launch files need another, libraries and plug-ins one each, what is included one note. A library or plug-in that "
    "another package of the workspace declares is a note, and so is a package that depends on this one itself: to "
    "declare it would close a cycle. Libraries of C++ are known by the keys of rosdep; modules of CMake need none.",
    why="rosdep does not install it, colcon and catkin may build this package before it, and a build of only this "
    "package fails on the next machine; today it works because another package happens to bring it.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest", "dependency"),
    clauses=("catkin_lint missing_depend",),
    fix="Declares packages of ROS, and libraries by the keys of rosdep that are known, in package.xml, behind "
    "dependencies of the same kind. Packages for both versions of ROS are left.",
    bad="find_package(tf2_ros REQUIRED)  # package.xml: nothing of tf2_ros",
    good="<depend>tf2_ros</depend>",
    found=found,
)
