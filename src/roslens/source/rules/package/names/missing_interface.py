"""Rule ``package.missing_interface``: a message, service or action is used that its package does not define."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from difflib import get_close_matches

from roslens.model.source import Language, SourceFile
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.rules.signatures.read_messages import whole_packages

_ID = "package.missing_interface"
_IMPORT = re.compile(
    rb"^from[ \t]+([a-z]\w*)(\.\w+)?[ \t]+import[ \t]*(?:\(([^()]*)\)|((?:[^\n#\\]|\\\n)*))", re.MULTILINE
)
_NAME = re.compile(rb"^\s*([A-Z]\w*)")
_HEADER = re.compile(r"^[<\"](\w+)/(msg|srv|action)/(?:detail/)?(\w+?)(?:__\w+)?\.(hpp|h)[>\"]$")
_OLD_HEADER = re.compile(r"^[<\"](\w+_(?:msgs|srvs))/([A-Z]\w*)\.h[>\"]$")
_CONDITIONAL = re.compile(rb"#\s*(?:if|elif)\b[^\n]*(?:ROS|has_include|CATKIN|AMENT)")
_KINDS = ("msg", "srv", "action")
_WORDS = re.compile(r"(.)([A-Z][a-z]+)")
_ENDS = re.compile(r"([a-z0-9])([A-Z])")
_PARTS = ("Action", "ActionGoal", "ActionResult", "ActionFeedback", "Goal", "Result", "Feedback")
"""Messages that genaction of ROS 1 makes of an action."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield each import and include of an interface that is not there."""
    if len(view.ros) != 1:
        return
    known = _known(view)
    for file in view.of_language(Language.PYTHON, Language.LAUNCH_PYTHON, Language.CPP, Language.C):
        if file.language.parsed_as == "python":
            yield from _imported(file, known, view)
        elif view.ros == {2}:
            yield from _included(file, known, view)


def _known(view: PackageView) -> Mapping[str, frozenset[str]]:
    """Return the names below ``package/kind`` of all packages whose definitions are known."""
    found = dict(whole_packages()) if view.ros == {2} else {}
    for package, definitions in view.around.definitions:
        for kind in _KINDS:
            names = {name.partition("/")[2] for name in definitions if name.startswith(f"{kind}/")}
            if names:
                found[f"{package}/{kind}"] = frozenset(names)
        if view.ros == {1}:
            _add_generated(package, definitions, found)
    return found


def _add_generated(package: str, definitions: tuple[str, ...], found: dict[str, frozenset[str]]) -> None:
    """Add what the generators of ROS 1 make of services and actions."""
    actions = [name.partition("/")[2] for name in definitions if name.startswith("action/")]
    made = frozenset(f"{name}{part}" for name in actions for part in _PARTS)
    if made or f"{package}/msg" in found:
        found[f"{package}/msg"] = found.get(f"{package}/msg", frozenset()) | made
    services = found.get(f"{package}/srv", frozenset())
    if services:
        found[f"{package}/srv"] = services | {f"{name}{part}" for name in services for part in ("Request", "Response")}


def _imported(file: SourceFile, known: Mapping[str, frozenset[str]], view: PackageView) -> Iterator[Hit]:
    content = view.read(file.path)
    for match in _IMPORT.finditer(content):
        package, module = match[1].decode(), (match[2] or b"").decode().removeprefix(".")
        if not any(f"{package}/{kind}" in known for kind in _KINDS):
            continue
        line = content.count(b"\n", 0, match.start()) + 1
        for part in (match[3] or match[4]).split(b","):
            name = _NAME.match(part)
            message = _of_import(package, module, name[1].decode(), known) if name is not None else ""
            if message and name is not None:
                yield Hit(_ID, message, line, context=name[1].decode(), path=file.path)


def _of_import(package: str, module: str, name: str, known: Mapping[str, frozenset[str]]) -> str:
    """Return what is wrong with the import of a name from a module of a package of interfaces."""
    where = next((kind for kind in _KINDS if name in known.get(f"{package}/{kind}", ())), "")
    if module in _KINDS:
        names = known.get(f"{package}/{module}")
        if names is None or name in names:
            return ""
        what = f"`{package}.{module}` has no `{name}`: an ImportError"
        return f"{what}; expected {_expected(package, module, name, where, known)}"
    if where and module in ("", *(f"{kind}s" for kind in _KINDS)):
        given = f"{package}.{module}".rstrip(".")
        return f"`{name}` is not in `{given}`: an ImportError; expected `from {package}.{where} import {name}`"
    return ""


def _expected(package: str, module: str, name: str, where: str, known: Mapping[str, frozenset[str]]) -> str:
    if where:
        return f"`from {package}.{where} import {name}`"
    other = next((key for key, names in sorted(known.items()) if name in names), "")
    if other:
        return f"`from {other.replace('/', '.')} import {name}`"
    near = get_close_matches(name, sorted(known.get(f"{package}/{module}", ())), 1)
    return f"`{near[0]}`" if near else f"a file {module}/{name}.{module} in {package}, or another name"


def _included(file: SourceFile, known: Mapping[str, frozenset[str]], view: PackageView) -> Iterator[Hit]:
    facts = view.facts.get(file.path)
    included = [one for one in facts.includes if _HEADER.match(one[0]) or _OLD_HEADER.match(one[0])] if facts else []
    if not included or _CONDITIONAL.search(view.read(file.path)):
        return
    for written, line in included:
        message = _of_include(written, known)
        if message:
            yield Hit(_ID, message, line, context=written, path=file.path)


def _of_include(written: str, known: Mapping[str, frozenset[str]]) -> str:
    """Return what is wrong with the header of an interface; empty where nothing is."""
    old = _OLD_HEADER.match(written)
    if old is not None:
        kind = "srv" if old[1].endswith("_srvs") else "msg"
        is_known = any(old[2] in known.get(f"{old[1]}/{one}", ()) for one in _KINDS)
        new = f"{old[1]}/{kind}/{_header(old[2])}.hpp"
        return f"{written} is a header of ROS 1; expected <{new}>" if is_known else ""
    match = _HEADER.match(written)
    if match is None:
        return ""
    package, kind, name, ending = match.groups()
    names = {_header(one): one for one in known.get(f"{package}/{kind}", ())}
    if ending == "hpp" and name != name.lower():
        return f"{written} is not made by rosidl; expected <{package}/{kind}/{_header(name)}.hpp>"
    if not names or name in names:
        return ""
    near = get_close_matches(name, sorted(names), 1)
    expected = f"<{package}/{kind}/{near[0]}.hpp>" if near else f"a definition in {package}"
    return f"{written}: {package} has no {kind} of this name; expected {expected}"


def _header(name: str) -> str:
    """Return the name of the header that rosidl makes of an interface."""
    return _ENDS.sub(r"\1_\2", _WORDS.sub(r"\1_\2", name)).lower()


RULE = PackageRule(
    id=_ID,
    title="Message, service or action that does not exist",
    finds="An import from `.msg`, `.srv` or `.action` of a package of the workspace, or of std_msgs, geometry_msgs, "
    "sensor_msgs, diagnostic_msgs, builtin_interfaces or std_srvs, that it does not define; an import of a message "
    "from the package itself (`from std_msgs import String`); and, for ROS 2, an include of such a header, one named "
    "as in ROS 1 (`std_msgs/String.h`) or by the name of the message (`msg/LaserScan.hpp`).",
    why="Python ends with an ImportError when the program starts; C++ is not compiled.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.PROVEN,
    profiles=("ros2", "ros1"),
    tags=("interfaces",),
    bad="from std_msgs.msg import LaserScan",
    good="from sensor_msgs.msg import LaserScan",
    found=found,
)
