"""Rule ``package.robot_tree``: a description of a robot that urdfdom refuses, or that no robot can be."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping

from roslens.model.source import Language, Role, SourceFile
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.source.rules.hit import Hit
from roslens.source.rules.package.configuration.expanded_robot import several_roots
from roslens.source.rules.package_view import PackageView
from roslens.source.rules.rule import PackageRule
from roslens.source.workspace.elements import Document, Element, read_elements

_ID = "package.robot_tree"
_TYPES = frozenset({"fixed", "floating", "planar", "revolute", "prismatic", "continuous"})
_LIMITED = frozenset({"revolute", "prismatic"})
_OPEN = re.compile(r"[$%{}@]")
"""Stands in a text of which a part is filled in later, by xacro or a build."""
_SLACK = 1.0001
"""Inertias are often written with few digits."""


def found(view: PackageView) -> Iterator[Hit]:
    """Yield what is wrong in each description of a whole robot, and in the joints and links of parts in xacro."""
    included = _included(view)
    pages = tuple(path.removesuffix("package.json") for path in view.listing if path.endswith("/package.json"))
    for file in view.of_language(Language.URDF, Language.XACRO, roles=(Role.OWN,)):
        if view.inside(file.path).startswith(pages):
            # Web pages read descriptions by programs of their own, which ask for less.
            continue
        content = view.read(file.path)
        document = read_elements(content) if b"<joint" in content or b"<link" in content else None
        if document is None or document.root is None or document.root.tag != "robot" or document.faults:
            continue
        robot = _Robot(file, document)
        yield from robot.numbers()
        if file.path.rpartition("/")[2] not in included:
            yield from _whole(robot, file, content, view)


def _whole(robot: _Robot, file: SourceFile, content: bytes, view: PackageView) -> Iterator[Hit]:
    """Yield what is wrong in the tree of a description that no other includes."""
    if b"xacro" not in content and not any(map(_OPEN.search, robot.names)):
        yield from robot.tree()
    elif b"xacro:include" in content and robot.is_named:
        yield from _expanded(file, view)


def _expanded(file: SourceFile, view: PackageView) -> Iterator[Hit]:
    """Yield that a robot of macros is no tree, where all of it is known."""
    roots, has_joints = several_roots(file.path, view)
    names = sorted(roots)
    for name in names[1:2]:
        place = roots[name]
        if place.path in view.by_path:
            several = ", ".join(map(repr, names[:4]))
            message = f"links {several} of {file.path} have no parent: several roots; expected one tree"
            # Links that only lie there, without any joint, may be the beginning of a robot; a macro was called for it.
            is_meant = has_joints or b"<xacro:macro" in view.read(place.path)
            certainty = None if is_meant else Certainty.HEURISTIC
            yield Hit(_ID, message, place.line, place.column, context=several, path=place.path, certainty=certainty)


def _included(view: PackageView) -> frozenset[str]:
    """Return the names of files that others include: they are parts of a robot."""
    found: set[str] = set()
    for file in view.of_language(Language.URDF, Language.XACRO):
        for name in re.findall(rb"""include\s[^<>]*filename\s*=\s*["']([^"']+)["']""", view.read(file.path)):
            found.add(name.decode("utf-8", "replace").rpartition("/")[2])
    return frozenset(found)


class _Robot:
    """The links and joints of a file: of a part those at any depth, but for what other elements have of these names."""

    def __init__(self, file: SourceFile, document: Document) -> None:
        self._path = file.path
        self._document = document
        root = document.root
        self._links = [] if root is None else [one for one in root.elements() if one.tag == "link"]
        self._joints = [] if root is None else [one for one in root.elements() if one.tag == "joint"]
        self._all = [] if root is None else list(_parts(root))
        self.is_named = root is not None and "name" in root.attributes
        self.names = [one.attributes.get("name", "") for one in (*self._links, *self._joints)]

    def tree(self) -> Iterator[Hit]:
        """Yield what urdfdom refuses of a whole robot: ``model.cpp``, ``joint.cpp`` and ``initTree`` of its model."""
        links = {one.attributes.get("name", ""): one for one in reversed(self._links)}
        for kind, several in (("link", self._links), ("joint", self._joints)):
            counts = Counter(one.attributes.get("name", "") for one in several)
            last = {one.attributes.get("name", ""): one for one in several}
            for name, one in last.items():
                if counts[name] > 1:
                    yield self._hit(one, f"{kind} {name!r} again; expected each name once")
        ends = list(self._ends(links))
        yield from ends
        yield from self._parents(links)
        if links and not ends:
            yield from self._roots(links)

    def _ends(self, links: Mapping[str, Element]) -> Iterator[Hit]:
        for joint in self._joints:
            for end in ("parent", "child"):
                name = _named(joint, end)
                if name not in links:
                    what = f"no link {name!r}" if name else "no link"
                    own = joint.attributes.get("name", "")
                    yield self._hit(joint, f"joint {own!r} has {what} as its {end}; expected one of this robot")

    def _parents(self, links: Mapping[str, Element]) -> Iterator[Hit]:
        children: dict[str, Element] = {}
        for joint in self._joints:
            child = _named(joint, "child")
            first = children.setdefault(child, joint)
            if first is not joint and child in links:
                names = (first.attributes.get("name", ""), joint.attributes.get("name", ""))
                yield self._hit(
                    joint,
                    f"link {child!r} is the child of joint {names[1]!r} and of {names[0]!r}: two parents, so that "
                    "one of the two transforms is lost; expected one",
                    Certainty.LIKELY,
                    Consequence.WRONG,
                )

    def _roots(self, links: Mapping[str, Element]) -> Iterator[Hit]:
        children = {_named(joint, "child") for joint in self._joints}
        roots = sorted(name for name in links if name not in children)
        if not roots:
            text = "each link is the child of another: no root; expected one link without a parent"
            yield self._hit(self._links[0], text)
        elif len(roots) > 1:
            text = f"links {', '.join(map(repr, roots[:4]))} have no parent: several roots; expected one tree"
            yield self._hit(links[roots[1]], text)

    def numbers(self) -> Iterator[Hit]:
        """Yield what the numbers of joints and links cannot be."""
        for one in self._all:
            if one.tag == "joint":
                yield from self._joint(one)
            else:
                yield from self._inertial(one)

    def _joint(self, joint: Element) -> Iterator[Hit]:
        name, kind = joint.attributes.get("name", ""), joint.attributes.get("type", "")
        if kind and not _OPEN.search(kind) and kind not in _TYPES:
            yield self._hit(joint, f"joint {name!r} is of type {kind!r}; expected one of {', '.join(sorted(_TYPES))}")
        limit = next((one for one in joint.elements() if one.tag == "limit"), None)
        # A macro may put the limit in.
        whole = all(":" not in one.tag for one in joint.elements())
        if kind in _LIMITED and limit is None and whole:
            yield self._hit(
                joint, f"joint {name!r} is {kind} and has no <limit>; expected one with effort and velocity"
            )
        if kind not in _LIMITED or limit is None or any(":" in one for one in limit.attributes):
            return
        lacking = [one for one in ("effort", "velocity") if one not in limit.attributes]
        if lacking:
            yield self._hit(limit, f"<limit> of joint {name!r} has no {' and no '.join(lacking)}; expected both")
        lower, upper = (_number(limit.attributes.get(one, "0")) for one in ("lower", "upper"))
        if lower is not None and upper is not None and lower > upper:
            yield self._hit(
                limit,
                f"joint {name!r} moves from {lower:g} to {upper:g}: no position is within these limits; expected lower "
                "below upper",
                Certainty.LIKELY,
                Consequence.WRONG,
            )

    def _inertial(self, link: Element) -> Iterator[Hit]:
        name = link.attributes.get("name", "")
        inertial = next((one for one in link.elements() if one.tag == "inertial"), None)
        for one in inertial.elements() if inertial is not None else ():
            mass = _number(one.attributes.get("value", "")) if one.tag == "mass" else None
            if mass is not None and mass < 0:
                text = f"link {name!r} has a mass of {mass:g} kg; expected a positive one"
                yield self._hit(one, text, Certainty.LIKELY, Consequence.WRONG)
            if one.tag == "inertia" and (why := _impossible(one)):
                text = f"inertia of link {name!r}: {why}, which no body has; expected that of its shape and mass"
                yield self._hit(one, text, Certainty.HEURISTIC, Consequence.MAY_BE_WRONG)

    def _hit(
        self,
        element: Element,
        message: str,
        certainty: Certainty | None = None,
        consequence: Consequence | None = None,
    ) -> Hit:
        line, column = self._document.place(element.start)
        return Hit(
            _ID, message, line, column, context=element.attributes.get("name", message), path=self._path,
            certainty=certainty, consequence=consequence,
        )  # fmt: skip


def _parts(root: Element) -> Iterator[Element]:
    """Yield links and joints of a robot, those in macros and conditions of xacro among them."""
    waiting = [root]
    while waiting:
        for one in waiting.pop().elements():
            if one.tag in ("link", "joint"):
                yield one
            elif one.tag.startswith("xacro:"):
                waiting.append(one)


def _named(joint: Element, end: str) -> str:
    return next((one.attributes.get("link", "") for one in joint.elements() if one.tag == end), "")


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _impossible(inertia: Element) -> str:
    """Return why no body has such an inertia: its principal moments obey the triangle inequality."""
    values = [_number(inertia.attributes.get(one, "")) for one in ("ixx", "iyy", "izz")]
    moments = [one for one in values if one is not None]
    if len(moments) < len(values) or not any(moments):
        return ""
    if min(moments) < 0:
        return f"a moment of {min(moments):g}"
    least, middle, most = sorted(moments)
    return f"moments {least:g}, {middle:g} and {most:g}" if most > (least + middle) * _SLACK else ""


RULE = PackageRule(
    id=_ID,
    title="Robot that cannot be",
    finds="In a description of a whole robot (URDF without xacro that no other includes): a name that is used twice, "
    "a joint to a link that is not there, links without a common root, a link with two parents. Of one in xacro that "
    "no other includes, where all macros, arguments and files are known: links without a common root. In any, also in "
    "parts in xacro: a joint of an unknown type, a revolute or prismatic joint without limits, effort or velocity, "
    "limits that leave no position, a negative mass, moments of inertia that no body has (a note).",
    why="urdfdom refuses the whole description, so that robot_state_publisher, MoveIt and the simulator end or have "
    "no robot; a joint without a position within its limits does not move, and impossible inertias make a simulation "
    "explode.",
    consequence=Consequence.STOPS_START,
    certainty=Certainty.LIKELY,
    profiles=("ros2", "ros1"),
    tags=("configuration", "description"),
    bad='<robot name="arm">\n  <link name="base"/>\n  <joint name="turn" type="fixed">\n    <parent link="base"/>\n'
    '    <child link="tool"/>\n  </joint>\n</robot>',
    good='<robot name="arm">\n  <link name="base"/>\n  <link name="tool"/>\n  <joint name="turn" type="fixed">\n'
    '    <parent link="base"/>\n    <child link="tool"/>\n  </joint>\n</robot>',
    found=found,
)
