"""Rule ``package.plugin_class``: plug-ins that are described and not registered, or registered and not described."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from roslens.model.source import Language, Role
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.extract.builds.plugin_xml import PluginClass
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.views.registered_classes import Registered, same_class

_ASKING = frozenset({"pluginlib", "nodelet", "class_loader"})


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each class of a description that no source registers, and each one registered that no description has."""
    if not _ASKING & {one.name for one in view.package.dependencies} and b"plugin=" not in _manifest(view):
        return
    registered, complete = view.registered
    plugins = [one for one in registered if one.base]
    if not complete or not plugins or any("<" in one.name for one in plugins):
        return
    described = list(_described(view))
    if described:
        yield from _unregistered(described, plugins, view)
        yield from _undescribed(described, plugins, view)


def _unregistered(described: Iterable[PluginClass], plugins: Sequence[Registered], view: PackageView) -> Iterator[Hit]:
    for one in described:
        # What is left over from ROS 1 in a package for ROS 2 is read by nobody.
        if one.parent.startswith("nodelet::") and 1 not in view.ros:
            continue
        if not one.type or "." in one.type or _is_elsewhere(one, view):
            continue
        if not any(same_class(one.type, each.name) for each in plugins):
            yield _unregistered_hit(one, view)


def _unregistered_hit(one: PluginClass, view: PackageView) -> Hit:
    """Return the hit at a class; one of a namespace that no source here has is another package's, which is a note."""
    where = one.evidence
    space, _, rest = one.type.removeprefix("::").partition("::")
    if rest and not _has_namespace(space, view):
        message = (
            f"no source of this package registers class {one.type!r} or has a namespace {space!r}; expected its "
            "description in the package that registers it"
        )
        certainty = Certainty.HEURISTIC
    elif _is_commented_out(one, view):
        message = f"the registration of class {one.type!r} is commented out; expected its description to go, too"
        certainty = Certainty.HEURISTIC
    else:
        expected = f"PLUGINLIB_EXPORT_CLASS({one.type}, {one.parent})"
        message, certainty = f"no source registers class {one.type!r}; expected {expected}", None
    return Hit("package.plugin_class", message, where.line, context=one.type, path=where.path, certainty=certainty)


def _has_namespace(name: str, view: PackageView) -> bool:
    """Return whether a source opens a namespace, or registers a class of it."""
    written = re.compile(rb"\bnamespace\s+(?:\w+::)*%b\b|\(\s*(?:::)?%b::" % (name.encode(), name.encode()))
    files = view.of_language(Language.CPP, Language.C)
    return any(written.search(view.read(file.path)) for file in files)


def _is_commented_out(one: PluginClass, view: PackageView) -> bool:
    """Return whether the registration of a class stands behind `//`."""
    name = re.escape(one.type.removeprefix("::").encode())
    written = re.compile(rb"//[^\n]*\b(?:PLUGINLIB_EXPORT_CLASS|PLUGINLIB_DECLARE_CLASS)\s*\([^\n]*\b%b\b" % name)
    return any(written.search(view.read(file.path)) for file in view.of_language(Language.CPP, Language.C))


def _is_elsewhere(one: PluginClass, view: PackageView) -> bool:
    """Return whether a class is one of a package that this one depends on, described here under a name of old."""
    others = {each.name for each in view.package.dependencies}
    return one.library.rpartition("/")[2] in others or one.type.removeprefix("::").partition("::")[0] in others


def _undescribed(described: Sequence[PluginClass], plugins: Iterable[Registered], view: PackageView) -> Iterator[Hit]:
    for each in plugins:
        if each.path in view.by_path and view.by_path[each.path].role is Role.TEST:
            continue
        # What is not ported yet lies there and is built by nothing.
        if not view.cmake.may_build(each.path):
            continue
        if not any(same_class(one.type or one.name.replace("/", "::"), each.name) for one in described):
            message = f"class {each.name!r} is registered, and no description of plug-ins names it; expected a <class>"
            yield Hit("package.plugin_class", message, each.line, context=each.name, path=each.path)


def _manifest(view: PackageView) -> bytes:
    return view.read(view.package.manifest.path)


def _described(view: PackageView) -> Iterator[PluginClass]:
    from roslens.source.extract.builds.plugin_xml import read_plugins

    for file in view.of_language(Language.XML, roles=(Role.OWN,)):
        content = view.read(file.path)
        if b"<library" in content and b"base_class_type" in content:
            yield from read_plugins(content, file.path)[0]


RULE = PackageRule(
    id="package.plugin_class",
    title="Plug-in that is not registered, or not described",
    finds="A `<class>` in a description of plug-ins that no source registers with `PLUGINLIB_EXPORT_CLASS`, and a "
    "registered class that no description names. Names are compared as far as namespaces are written; classes of "
    "packages that this one depends on are let be, and a class of a namespace that no source of the package has is a "
    "note: another package may register it.",
    why='Loading it fails when the robot starts ("class … does not exist", or "failed to load library"), which no '
    "compiler sees.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("plugin",),
    bad='PLUGINLIB_EXPORT_CLASS(arm::Driver, nodelet::Nodelet)  // plugins.xml: <class type="arm::Drivr" …/>',
    good='PLUGINLIB_EXPORT_CLASS(arm::Driver, nodelet::Nodelet)  // plugins.xml: <class type="arm::Driver" …/>',
    found=found,
)
