"""What is different between two configurations: nodes, endpoints, types, qualities, remappings and parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec

from roslens.compare.ways import Way, fewest
from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode
from roslens.model.qos import quality_text


class Difference(msgspec.Struct, frozen=True, order=True):
    """One difference.

    Attributes:
        node: that has it; empty where it is of no node.
        what: ``node``, the role of an endpoint, ``parameter`` or ``remapping``.
        name: of it.
        how: ``added``, ``removed`` or ``changed``.
        before: in words; empty where it is added, or where nothing of several is lost.
        after: in words; empty where it is removed, or where nothing is new among several.
    """

    node: str
    what: str
    name: str
    how: str
    before: str = ""
    after: str = ""


def differences(before: Configuration, after: Configuration) -> tuple[Difference, ...]:
    """Return the differences, those of a node together; places in files are none."""
    old, new = _nodes(before), _nodes(after)
    found: list[Difference] = []
    for name in sorted(old.keys() | new.keys()):
        first, second = old.get(name, []), new.get(name, [])
        if not first or not second:
            how = "removed" if first else "added"
            found += [_of_node(one, how) for one in first or second]
            continue
        for place, text in (("number of nodes", _count), ("start", _start)):
            one, two = text(first), text(second)
            if one != two:
                found.append(Difference(name, "node", place, "changed", one, two))
        found += _differences_of_node(name, _facts(first), _facts(second))
    found += _differences_of_node("", _outside(before), _outside(after))
    return tuple(found)


_Facts = dict[tuple[str, str], frozenset[str]]


def _nodes(configuration: Configuration) -> dict[str, list[ConfiguredNode]]:
    found: dict[str, list[ConfiguredNode]] = {}
    for node in configuration.nodes:
        found.setdefault(node.name, []).append(node)
    return found


def _count(nodes: Sequence[ConfiguredNode]) -> str:
    return str(len(nodes))


def _start(nodes: Sequence[ConfiguredNode]) -> str:
    return "; ".join(sorted({_program(node) for node in nodes}))


def _program(node: ConfiguredNode) -> str:
    where = f" in {node.container}" if node.container else ""
    conditions = "".join(f", if {one}" for one in node.conditions)
    return f"{node.package}/{node.executable}{where}{conditions}"


def _of_node(node: ConfiguredNode, how: str) -> Difference:
    text = _program(node)
    return Difference(node.name, "node", "", how, "" if how == "added" else text, "" if how == "removed" else text)


def _facts(nodes: Sequence[ConfiguredNode]) -> _Facts:
    found: dict[tuple[str, str], dict[str, set[Way]]] = {}
    for node in nodes:
        for key, value, way in _things(node):
            found.setdefault(key, {}).setdefault(value, set()).add(way)
    return {key: frozenset(_texts(ways)) for key, ways in found.items()}


def _things(node: ConfiguredNode) -> Iterator[tuple[tuple[str, str], str, Way]]:
    """Yield what a node has: what kind of thing with its name, what is said of it, and under which conditions."""
    for one in node.endpoints:
        yield (one.endpoint.role.value.replace("_", " "), one.endpoint.name), _end(one), one.conditions
    for parameter in node.parameters:
        if (parameter.access or parameter.set_by is not None) and not parameter.repeats_an_endpoint:
            value = "unknown" if parameter.value is None else f'"{parameter.value}"'
            yield ("parameter", parameter.name), value, ()
    for remap in node.remaps:
        yield ("remapping", remap.source), remap.target, ()


def _texts(ways: Mapping[str, set[Way]]) -> Iterator[str]:
    for text, conditions in ways.items():
        for way in fewest(conditions):
            yield ", ".join([text, *(f"if {condition}" for condition in way)])


def _end(one: ConfiguredEndpoint) -> str:
    quality = quality_text(one.endpoint.qos) if one.endpoint.qos else ""
    queue = f"queue {one.queue}" if one.queue >= 0 and one.endpoint.qos is None else ""
    words = [one.endpoint.type or "type unknown", quality, queue, "latched" if one.latched else ""]
    return ", ".join(word for word in words if word)


def _outside(configuration: Configuration) -> _Facts:
    return {("parameter", one.name): frozenset([f'"{one.value}"']) for one in configuration.parameters}


def _differences_of_node(node: str, before: _Facts, after: _Facts) -> Iterator[Difference]:
    """Yield what is different; of what is there several times what is the same is left out."""
    for key in sorted(before.keys() | after.keys()):
        one, two = before.get(key, frozenset()), after.get(key, frozenset())
        if one != two:
            how = "added" if not one else "removed" if not two else "changed"
            yield Difference(node, *key, how, "; ".join(sorted(one - two)), "; ".join(sorted(two - one)))
