"""The links and joints of a robot that xacro makes of macros, arguments and included files."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.source.extract.facts.files import FolderFiles
from roslens.source.extract.launch.robot_description import read_description
from roslens.source.rules.package_view import PackageView

if TYPE_CHECKING:
    from roslens.source.extract.facts.node_facts import Evidence
    from roslens.source.extract.launch.robot_description import Described


def several_roots(path: str, view: PackageView) -> tuple[dict[str, Evidence], bool]:
    """Return the links without a parent of a description, if they are several, and whether it has any joint.

    No link where something of it is not known: a file of another package, an argument without default, a condition.
    """
    files = FolderFiles(Path(view.root), {view.package.name: view.folder})
    root, missing = read_description(path, files)
    if root is None or missing or root.tag != "robot":
        return {}, False
    parts = [one for one in root.children if one.tag in ("link", "joint")]
    named = {_known(one, "name"): one.evidence for one in reversed(parts) if one.tag == "link"}
    ends = [tuple(_ends(one)) for one in parts if one.tag == "joint"]
    if any(one.conditions for one in parts) or None in named or any(None in pair for pair in ends):
        return {}, False
    links = {name: place for name, place in named.items() if name is not None}
    children = {pair[-1] for pair in ends}
    roots = {name: place for name, place in links.items() if name not in children}
    # A part that no joint holds, where joints name links that are not here, waits for the rest of the robot.
    return (roots if len(roots) > 1 and children <= links.keys() else {}), bool(ends)


def _ends(joint: Described) -> Iterator[str | None]:
    """Yield the links that a joint connects, the parent first; None for one that is not known."""
    for end in ("parent", "child"):
        named = [one for one in joint.children if one.tag == end]
        yield _known(named[0], "link") if len(named) == 1 and not named[0].conditions else None


def _known(one: Described, attribute: str) -> str | None:
    text = one.attributes.get(attribute)
    return None if text is None else text.known
