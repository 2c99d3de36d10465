"""Descriptions of robots (URDF, SDF, xacro) as the elements that they come to, without running xacro.

Follows wiki.ros.org/xacro: properties, arguments, macros with defaults and blocks, conditions, includes, expressions;
with the prefix ``xacro:`` and, as old files have it, without. What cannot be known is a hole, or a condition of the
elements it stands around.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping

import msgspec

from roslens.source.extract.facts.files import Files, joined
from roslens.source.extract.facts.launched import Unresolved
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.launch.ros1_substitution import Scope, SubstitutionError, substitute
from roslens.source.extract.symbolic.python_expression import Plain, UnknownError, evaluate
from roslens.source.extract.symbolic.text import Conditions, Hole, Not, Text, Written, unknown
from roslens.source.workspace.elements import Document, Element, read_elements

MOST_ELEMENTS = 30_000
MOST_DEPTH = 40
"""Macros and files inside each other deeper than this hold themselves."""
_PREFIX = "xacro:"
_EXPRESSION = re.compile(r"\$\{([^}]*)\}")
_PARAMETER = re.compile(r"""(\*{0,2})([\w.]+)(?:(:?=)(\^?\|?)('[^']*'|"[^"]*"|\$\{[^}]*\}|[^\s]*))?""")
_NAME = re.compile(r"[A-Za-z_]\w*")
_CONSTANTS = {"pi": 3.141592653589793, "True": True, "False": False}


class Described(msgspec.Struct, frozen=True):
    """An element of a description: with its text and where it is written.

    Attributes:
        tag: its name.
        attributes: of it.
        text: directly inside.
        children: elements in it.
        evidence: where it is written.
        conditions: that cannot be evaluated, outermost first.
    """

    tag: str
    attributes: dict[str, Text]
    text: Text
    children: tuple[Described, ...]
    evidence: Evidence
    conditions: Conditions = ()

    def walk(self) -> Iterator[tuple[Described, ...]]:
        """Yield the path to this element and to each one below it, outermost first."""
        yield (self,)
        for child in self.children:
            for path in child.walk():
                yield (self, *path)


def read_description(
    path: str, files: Files, arguments: Mapping[str, Text] | None = None, environment: Mapping[str, str] | None = None
) -> tuple[Described | None, tuple[Unresolved, ...]]:
    """Return what a description comes to, and what of it is missing; None where nothing can be read.

    Args:
        path: of the file in the workspace.
        files: that may be read.
        arguments: as xacro is given them, by name.
        environment: variables that are known.
    """
    whole = _Whole(files, dict(arguments or {}), environment or {})
    found = _file(path, _Space(whole))
    if not found:
        whole.missing.append(Unresolved(path, Evidence(path, 0), "there is no such description in the workspace"))
    return (found[0] if found else None), tuple(dict.fromkeys(whole.missing))


class _Macro(msgspec.Struct, frozen=True):
    parameters: tuple[tuple[str, str, str | None, bool], ...]
    body: Element
    document: Document
    path: str


class _Whole:
    """What holds everywhere in one description."""

    def __init__(self, files: Files, given: dict[str, Text], environment: Mapping[str, str]) -> None:
        self.files, self.given, self.environment = files, given, environment
        self.macros: dict[str, _Macro] = {}
        self.defaults: dict[str, Text] = {}
        self.missing: list[Unresolved] = []
        self.left = MOST_ELEMENTS


class _Space:
    """What holds at a place: properties and blocks, and those around it."""

    def __init__(self, whole: _Whole, outer: _Space | None = None) -> None:
        self.whole, self.outer = whole, outer
        self.depth: int = 0 if outer is None else outer.depth + 1
        self.properties: dict[str, Text] = {}
        self.blocks: dict[str, tuple[Described, ...]] = {}

    def find(self, name: str) -> Text | None:
        """Return a property."""
        space: _Space | None = self
        while space is not None:
            if name in space.properties:
                return space.properties[name]
            space = space.outer
        return None

    def block(self, name: str) -> tuple[Described, ...]:
        """Return what a block holds."""
        space: _Space | None = self
        while space is not None:
            if name in space.blocks:
                return space.blocks[name]
            space = space.outer
        return ()

    def top(self) -> _Space:
        """Return the outermost place."""
        space = self
        while space.outer is not None:
            space = space.outer
        return space


class _Place(msgspec.Struct, frozen=True):
    """Where elements are read: the file, what holds, and conditions around."""

    document: Document
    path: str
    space: _Space
    conditions: Conditions = ()

    def evidence(self, element: Element) -> Evidence:
        """Return where an element stands."""
        return Evidence(self.path, *self.document.place(element.start))


def _file(path: str, space: _Space, conditions: Conditions = ()) -> tuple[Described, ...]:
    content = space.whole.files.content(path)
    if content is None or space.depth > MOST_DEPTH:
        return ()
    document = read_elements(content)
    if document.root is None:
        return ()
    return _expanded(document.root, _Place(document, path, space, conditions))


def _expanded(element: Element, place: _Place) -> tuple[Described, ...]:
    """Return what an element comes to: itself, what it includes or makes, or nothing."""
    whole = place.space.whole
    whole.left -= 1
    if whole.left < 0 or place.space.depth > MOST_DEPTH:
        return ()
    name = element.tag.removeprefix(_PREFIX)
    special = _SPECIAL.get(name)
    if special is not None and (element.tag != name or (name in _LEGACY and _LEGACY[name] in element.attributes)):
        return special(element, place)
    called = name
    if name == "call":
        called = _text(element.attributes.get("macro", ""), place).known or ""
    macro = whole.macros.get(called)
    if macro is not None:
        return _call(macro, element, place)
    if element.tag != name:
        _miss(element.tag, element, place, "no such macro is known in the workspace")
        return ()
    return (
        Described(
            element.tag,
            {key: _text(value, place) for key, value in element.attributes.items()},
            _text(element.text(), place),
            _children(element, place),
            place.evidence(element),
            place.conditions,
        ),
    )


def _children(element: Element, place: _Place) -> tuple[Described, ...]:
    return tuple(one for child in element.elements() for one in _expanded(child, place))


def _include(element: Element, place: _Place) -> tuple[Described, ...]:
    written = _text(element.attributes.get("filename", ""), place)
    name = written.known
    if not name:
        _miss(str(written), element, place, "the file that is included is unknown")
        return ()
    folder = place.path.rpartition("/")[0]
    found = [name] if place.space.whole.files.content(joined("", name)) is not None else [f"{folder}/{name}"]
    # Files inside each other count as one deeper, so that one that includes itself ends; what it sets holds here too.
    space = _Space(place.space.whole, place.space)
    space.properties, space.blocks = place.space.properties, place.space.blocks
    included = _file(joined("", found[0]), space, place.conditions)
    if not included:
        _miss(name, element, place, "there is no such file in the workspace")
    return tuple(child for root in included for child in root.children)


def _miss(text: str, element: Element, place: _Place, reason: str) -> None:
    place.space.whole.missing.append(Unresolved(text, place.evidence(element), reason))


def _property(element: Element, place: _Place) -> tuple[Described, ...]:
    name, given = element.attributes.get("name", ""), element.attributes
    target = place.space.top() if given.get("scope") == "global" else place.space
    if given.get("scope") == "parent" and place.space.outer is not None:
        target = place.space.outer
    if "value" in given:
        target.properties[name] = _text(given["value"], place)
    elif "default" in given:
        if place.space.find(name) is None:
            target.properties[name] = _text(given["default"], place)
    else:
        target.blocks[name] = _children(element, place)
    return ()


def _argument(element: Element, place: _Place) -> tuple[Described, ...]:
    if "default" in element.attributes:
        place.space.whole.defaults.setdefault(
            element.attributes.get("name", ""), _text(element.attributes["default"], place)
        )
    return ()


def _macro(element: Element, place: _Place) -> tuple[Described, ...]:
    parameters = []
    for match in _PARAMETER.finditer(element.attributes.get("params", "")):
        default = match[5].strip("'\"") if match[3] else None
        parameters.append((match[1], match[2], default, "^" in (match[4] or "")))
    name = element.attributes.get("name", "").removeprefix(_PREFIX)
    place.space.whole.macros[name] = _Macro(tuple(parameters), element, place.document, place.path)
    return ()


def _call(macro: _Macro, element: Element, place: _Place) -> tuple[Described, ...]:
    space = _Space(place.space.whole, place.space)
    blocks = iter([child for child in element.elements() if child.tag != "call"])
    for stars, name, default, outside in macro.parameters:
        if stars:
            block = next(blocks, None)
            found = () if block is None else _expanded(block, place)
            space.blocks[name] = found if stars == "*" else tuple(one for root in found for one in root.children)
        elif name in element.attributes:
            space.properties[name] = _text(element.attributes[name], place)
        elif outside and (known := place.space.find(name)) is not None:
            space.properties[name] = known
        elif default is not None:
            space.properties[name] = _text(default, place)
        else:
            space.properties[name] = unknown(f"{name}, which the macro call does not set")
    return _children(macro.body, _Place(macro.document, macro.path, space, place.conditions))


def _insert(element: Element, place: _Place) -> tuple[Described, ...]:
    return place.space.block(_text(element.attributes.get("name", ""), place).known or "")


def _if(element: Element, place: _Place) -> tuple[Described, ...]:
    return _conditional(element, place, wanted=True)


def _unless(element: Element, place: _Place) -> tuple[Described, ...]:
    return _conditional(element, place, wanted=False)


def _conditional(element: Element, place: _Place, *, wanted: bool) -> tuple[Described, ...]:
    written = element.attributes.get("value", "")
    known = _text(written, place).known
    if known is None:
        condition = Written(written) if wanted else Not(Written(written))
        return _children(element, msgspec.structs.replace(place, conditions=(*place.conditions, condition)))
    value = _converted(known)
    match value:
        case str():
            holds = value.strip().lower() not in ("", "false")
        case _:
            holds = bool(value)
    return _children(element, place) if holds is wanted else ()


_SPECIAL: dict[str, Callable[[Element, _Place], tuple[Described, ...]]] = {
    "include": _include, "property": _property, "arg": _argument, "macro": _macro, "insert_block": _insert,
    "if": _if, "unless": _unless,
}  # fmt: skip
_LEGACY = {"property": "name", "macro": "params", "insert_block": "name", "if": "value", "unless": "value",
           "include": "filename"}  # fmt: skip
"""What xacro took for its own without the prefix too, before Jade, where it has this attribute."""


def _text(written: str, place: _Place) -> Text:
    """Return a text with its expressions and substitutions made."""
    if "$" not in written:
        return Text.of(written)
    parts: list[str | Text] = []
    at = 0
    for match in _EXPRESSION.finditer(written):
        parts.append(_substituted(written[at : match.start()], place))
        parts.append(_evaluated(match[1], place))
        at = match.end()
    return Text.of(*parts, _substituted(written[at:], place))


def _substituted(written: str, place: _Place) -> Text:
    if "$(" not in written:
        return Text.of(written)
    whole = place.space.whole
    known = {**whole.defaults, **whole.given}
    try:
        return substitute(written, Scope(whole.files, place.path.rpartition("/")[0], known, whole.environment))
    except SubstitutionError as error:
        return unknown(str(error))


def _evaluated(expression: str, place: _Place) -> Text:
    inner = _substituted(expression, place)
    if inner.known is None:
        return Text((Hole(inner.holes[0].reason),))
    names: dict[str, Plain] = dict(_CONSTANTS)
    for name in set(_NAME.findall(inner.known)):
        value = place.space.find(name)
        if value is not None and value.known is not None:
            names[name] = _converted(value.known)
        elif value is not None:
            if inner.known.strip() == name:
                return value
            return Text((Hole(value.holes[0].reason),))
    try:
        value_of = evaluate(inner.known, names, {})
    except UnknownError as error:
        return unknown(f"${{{expression}}}: {error}")
    return Text.of(str(value_of))


def _converted(text: str) -> Plain:
    """Return a value as xacro converts it: int, float, bool, else text."""
    for convert in (int, float):
        try:
            return convert(text)
        except ValueError:
            continue
    return {"true": True, "false": False}.get(text.strip().lower(), text)
