"""Names as ROS resolves them: relative, private and global ones, namespaces and remappings.

ROS 1 follows wiki.ros.org/Names and Remapping Arguments: a remapping holds for the resolved name, the last one of a
name wins. ROS 2 follows design.ros2.org/articles/static_remapping.html: rules hold for expanded names in order, the
first that matches is applied, once. Names with holes stay patterns.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache

import msgspec

from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.symbolic.text import Text

TOP = Text(("/",))
_OF_NODE = re.compile(r"([A-Za-z_]\w*):(?!/)(.+)", re.DOTALL)
_SCHEME = re.compile(r"ros(?:topic|service)://")
_SLASHES = re.compile(r"/{2,}")
_WORD = re.compile(r"\w+")


class Rule(msgspec.Struct, frozen=True):
    """A remapping; ``node`` is the name of the only node it is for, empty for all of a process."""

    source: Text
    target: Text
    evidence: Evidence
    node: str = ""

    @property
    def special(self) -> str:
        """``__node``, ``__name`` or ``__ns`` where it renames the node itself; else empty."""
        known = self.source.known or ""
        return known if known.startswith("__") else ""


class Place(msgspec.Struct, frozen=True):
    """What names are resolved against: the namespace and the whole name of a node.

    ``supposed`` says in words which parts of them are defaults that the environment may change.
    """

    namespace: Text
    node: Text
    generation: str
    supposed: tuple[str, ...] = ()


def rule(source: Text, target: Text, evidence: Evidence) -> Rule:
    """Return a remapping as written, the name of a node in front of it taken apart."""
    node = ""
    first = source.head
    if first:
        match = _OF_NODE.fullmatch(first)
        if match:
            node, first = match[1], match[2]
        source = Text.of(_SCHEME.sub("", first, count=1), *source.behind)
    return Rule(source, target, evidence, node)


def below(namespace: Text, name: Text) -> Text:
    """Return a relative name below a namespace."""
    if not name.parts:
        return namespace
    return Text.of("/", name) if namespace.parts in ((), ("/",)) else Text.of(namespace, "/", name)


def absolute(namespace: Text, given: Text) -> Text:
    """Return a namespace given in another one: below it, or itself where it begins with ``/``."""
    if not given.parts:
        return namespace
    return tidy(given if given.is_global else below(namespace, given))


def tidy(name: Text) -> Text:
    """Return a name without doubled separators and without one at its end."""
    whole = name.known
    if whole is not None and "//" not in whole and not whole.endswith("/"):
        return name
    single = name.with_known(lambda part: _SLASHES.sub("/", part))
    last = single.tail.rstrip("/")
    return Text.of(*single.before, last if single.holes else last or single.tail[:1])


def expand(name: Text, place: Place) -> Text:
    """Return a name with namespace and node in place, before remapping.

    A name that begins with a hole is kept: nobody knows whether it is a global one.
    """
    if place.generation == "ros2":
        name = _substituted(name, place)
    if not name.parts:
        return place.namespace
    first = name.head
    if not first:
        return name
    if first.startswith("~"):
        return tidy(below(place.node, Text.of(first[1:].lstrip("/"), *name.behind)))
    return tidy(name if first.startswith("/") else below(place.namespace, name))


def _substituted(name: Text, place: Place) -> Text:
    if "{" not in name.pattern:
        return name
    whole = place.node.known
    values = {"namespace": place.namespace, "ns": place.namespace, "node": Text.of(base_name(whole) if whole else "*")}
    pieces: list[Text] = []
    for part in name.parts:
        match part:
            case str():
                for number, piece in enumerate(re.split(r"\{(namespace|ns|node)\}", part)):
                    pieces.append(values[piece] if number % 2 else Text.of(piece))
            case _:
                pieces.append(Text((part,)))
    return Text.of(*pieces)


def base_name(name: str) -> str:
    """Return the last part of a name."""
    return name.rstrip("/").rpartition("/")[2]


def resolve(name: Text, place: Place, rules: Sequence[Rule]) -> tuple[Text, Rule | None]:
    """Return a name as it is in the running system, and the remapping that changed it."""
    expanded = expand(name, place)
    node = base_name(place.node.pattern)
    for one in rules if place.generation == "ros2" else reversed(rules):
        if one.special or (one.node and one.node != node):
            continue
        if expand(one.source, place) == expanded:
            return expand(one.target, place), one
    return expanded, None


def may_match(one: Rule, name: Text, place: Place) -> bool:
    """Return whether a remapping may be meant for a name of which a part is unknown."""
    if not (name.holes or one.source.holes or place.namespace.holes or place.node.holes):
        return False
    source, expanded = expand(one.source, place), expand(name, place)
    if not (source.holes or expanded.holes):
        return False
    known, pattern = (source, expanded) if expanded.holes else (expanded, source)
    if known.holes:
        return True
    return _fits([part if isinstance(part, str) else None for part in pattern.parts], known.pattern)


def _fits(parts: Sequence[str | None], text: str) -> bool:
    """Return whether texts stand in this order in a text, with anything where None is, in linear time."""
    words = [""]
    for part in parts:
        if part is None:
            words.append("")
        else:
            words[-1] += part
    first, *between = words
    if not between:
        return first == text
    last = between.pop()
    if len(first) + len(last) > len(text) or not (text.startswith(first) and text.endswith(last)):
        return False
    place, end = len(first), len(text) - len(last)
    for word in between:
        found = text.find(word, place, end)
        if found < 0:
            return False
        place = found + len(word)
    return True


def renamed(what: str, name: str, rules: Sequence[Rule], generation: str) -> Rule | None:
    """Return the rule that gives a node its name (``__node``) or namespace (``__ns``), if one does."""
    names = {"__node": ("__node", "__name"), "__ns": ("__ns",)}[what]
    for one in rules if generation == "ros2" else reversed(rules):
        if one.special in names and (not one.node or one.node == name):
            return one
    return None


def node_pattern_matches(pattern: str, node: str) -> bool:
    """Return whether a file of parameters of ROS 2 that is keyed to ``pattern`` is for a node.

    ``/*`` stands for one part of a name, ``/**`` for any number of them (rclcpp, parameter_map.cpp).
    """
    if pattern == node:
        return True
    return "*" in pattern and _matches(pattern, node)


@lru_cache(maxsize=4096)
def _matches(pattern: str, node: str) -> bool:
    """Follow all places up to which the beginning of a pattern may reach: one step a piece, whatever the pattern."""
    places = {0}
    for piece in re.split(r"(/\*\*|/\*)", pattern):
        if piece == "/*":
            places = _after_a_part(node, places)
        elif piece == "/**":
            more = places
            while more := _after_a_part(node, more) - places:
                places |= more
        else:
            places = {place + len(piece) for place in places if node.startswith(piece, place)}
    return len(node) in places


def _after_a_part(node: str, places: set[int]) -> set[int]:
    found: set[int] = set()
    for place in places:
        if node.startswith("/", place):
            part = _WORD.match(node, place + 1)
            found.update(range(place + 2, part.end() + 1) if part else ())
    return found
