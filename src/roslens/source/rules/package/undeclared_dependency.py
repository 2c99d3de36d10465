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
from roslens.source.rules.views.downloaded_projects import downloaded
from roslens.source.rules.views.library_uses import LIBRARIES
from roslens.source.rules.views.renamed_package import name_now

_WAYS = ("find_package", "import", "launch", "library", "plug-in", "#include")
"""Beginnings of how a package is used, in the order in which they count where as many files use one as the other."""
_BY = {
    "find_package": "by find_package",
    "#include": "by #include",
    "import": "by import",
    "launch": "by launch files",
    "library": "by import",
    "plug-in": "as plug-ins",
}
_TAGS_OF_FORMAT_1: dict[str, tuple[str, ...]] = {
    BUILD: ("build_depend", "run_depend"),
    RUN: ("run_depend",),
    TEST: ("test_depend",),
}
_TAGS_OF_FORMAT_2: dict[str, tuple[str, ...]] = {BUILD: ("depend",), RUN: ("exec_depend",), TEST: ("test_depend",)}
_RULE = "package.undeclared_dependency"


def found(view: PackageView) -> Iterator[Hit]:
    """Yield at once all packages that are used and not declared, and each that would close a cycle."""
    declared = {one.name for one in (*view.package.dependencies, *view.package.member_of_groups)}
    uses: dict[str, Use] = {}
    for use in view.uses:
        if use.name in uses or not _expected(use, view) or any(_is_said(key, use) for key in declared):
            continue
        uses[use.name] = use
    for use in uses.values():
        if _closes_cycle(use, view):
            yield _cyclic(use, view)
    missing = [use for use in uses.values() if not _closes_cycle(use, view)]
    if missing:
        yield _together(sorted(missing, key=lambda use: _rank(use, view)), view)


def _rank(use: Use, view: PackageView) -> tuple[bool, bool, int, int]:
    """Return what comes first, smallest: what nothing else brings, what is not for tests, what most files need."""
    return _is_brought(use, view), use.when == TEST, -use.files, _WAYS.index(_way(use))


def _way(use: Use) -> str:
    return next(way for way in _WAYS if use.how.startswith(way))


def _is_brought(use: Use, view: PackageView) -> bool:
    """Return whether another dependency brings it: what is included, without a search, was found in the build."""
    way = _way(use)
    return way == "#include" or (way in ("plug-in", "library") and _is_said_elsewhere(use, view))


def _together(uses: Sequence[Use], view: PackageView) -> Hit:
    first = uses[0]
    others = {use.name: name_now(use.name, view) for use in uses}
    if len(uses) == 1 and _way(first) == "find_package":
        message = f"{first.how}: package.xml does not declare {first.name!r}; expected {_tag(first, view)}"
    else:
        by_way: dict[str, list[str]] = {}
        for use in uses:
            by_way.setdefault(_BY[_way(use)], []).append(_named(use))
        ways = ", ".join(f"{', '.join(names)} ({way})" for way, names in by_way.items())
        tags = " and ".join(dict.fromkeys(f"<{tag}>" for use in uses for tag in _tags(view)[use.when]))
        message = f"package.xml does not declare what the package needs: {ways}; expected {tags}"
    return Hit(
        _RULE,
        "; ".join((message, *filter(None, others.values()))),
        first.line,
        context=" ".join(use.name for use in sorted(uses, key=lambda use: use.name)),
        path=first.path,
        certainty=Certainty.HEURISTIC if _is_brought(first, view) else None,
        edits=() if any(others.values()) else _declared(uses, view),
    )


def _is_said_elsewhere(use: Use, view: PackageView) -> bool:
    """Return whether another package of the workspace declares it: it is installed with that one."""
    return any(_is_said(key, use) for key in view.around.declared)


def _tags(view: PackageView) -> dict[str, tuple[str, ...]]:
    """Return the elements that declare a package, by when it is needed, as the format of the manifest has them."""
    return _TAGS_OF_FORMAT_1 if view.manifest_edits.format == 1 else _TAGS_OF_FORMAT_2


def _tag(use: Use, view: PackageView) -> str:
    """Return what is expected in package.xml, with the key where the name is none itself."""
    key = KEY_OF.get(use.name, "")
    return " and ".join(f"<{tag}>{key}</{tag}>" if key else f"<{tag}>" for tag in _tags(view)[use.when])


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
    return Hit(_RULE, message, use.line, context=other, path=use.path, certainty=certainty)


def _declared(uses: Sequence[Use], view: PackageView) -> tuple[Edit, ...]:
    """Return what declares all of some packages; nothing where the key of one, or its condition, is not certain."""
    manifest = view.manifest_edits
    here = {name for name, _ in view.around.folders}
    if not manifest.format or len(view.ros) > 1 or not all(use.name in here or _is_known(use) for use in uses):
        return ()
    tags = _tags(view)
    return joined([manifest.added(tag, KEY_OF.get(use.name, use.name)) for use in uses for tag in tags[use.when]])


def _is_known(use: Use) -> bool:
    by_name = use.how.startswith(("plug-in", "library")) or use.name.startswith("ament_")
    return by_name or is_ros_package(use.name) or use.name in KEY_OF


def _named(use: Use) -> str:
    """Return a package as messages name it; a library by its key too."""
    how, _, module = use.how.partition(" ")
    if how == "library":
        return f"{module!r} by the key {use.name!r}"
    key = KEY_OF.get(use.name, use.name)
    return f"{use.name!r} by the key {key!r}" if key != use.name else repr(use.name)


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
    if name.lower() in downloaded(view.cmake):
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
    id=_RULE,
    title="Package used and not declared",
    finds="A package that CMakeLists.txt finds, that a launch file finds or starts nodes of, that has a plug-in which "
    "parameters name (controllers of ros2_control, plug-ins of Nav2 and MoveIt), or, of ROS, that sources include or "
    "import, and of which package.xml says nothing; also libraries of Python that only rosdep installs, such as "
    "pyserial, where no list for pip or image installs them. All of a manifest are one finding, at what most of its "
    "files need. What is only included, and a library or plug-in that another package of the workspace declares, make "
    "a note where there is nothing else, and so does a package that depends on this one itself: to declare it would "
    "close a cycle. Where a distribution has the package under another name, or the workspace one of almost that name, "
    "the message says so. Libraries of C++ are known by the keys of rosdep; modules of CMake need none, nor does what "
    "CMakeLists.txt downloads.",
    why="rosdep does not install it, colcon and catkin may build this package before it, and a build of only this "
    "package fails on the next machine; today it works because another package happens to bring it.",
    consequence=Consequence.HARD_TO_MAINTAIN,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("manifest", "dependency"),
    clauses=("catkin_lint missing_depend",),
    fix="Declares packages of ROS, and libraries by the keys of rosdep that are known, in package.xml, behind "
    "dependencies of the same kind. A manifest that lacks one that is not known is left, and so are packages for both "
    "versions of ROS.",
    bad="find_package(tf2_ros REQUIRED)  # package.xml: nothing of tf2_ros",
    good="<depend>tf2_ros</depend>",
    found=found,
)
