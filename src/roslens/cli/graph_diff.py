"""What is different between two configurations: nodes, endpoints, types, qualities, remappings and parameters."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec

from roslens.model.configuration import Configuration, ConfiguredEndpoint, ConfiguredNode
from roslens.report.graph_text import quality_text

_SIGNS = {"added": "+", "removed": "-", "changed": "~"}


class Difference(msgspec.Struct, frozen=True, order=True):
    """One difference.

    Attributes:
        node: that has it; empty where it is of no node.
        what: ``node``, the role of an endpoint, ``parameter`` or ``remapping``.
        name: of it.
        how: ``added``, ``removed`` or ``changed``.
        before: in words; empty where it is added.
        after: in words; empty where it is removed.
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
        found += _told(name, _facts(first), _facts(second))
    found += _told("", _outside(before), _outside(after))
    return tuple(found)


_Facts = dict[tuple[str, str], str]


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
    found: dict[tuple[str, str], set[str]] = {}
    for node in nodes:
        for one in node.endpoints:
            key = (one.endpoint.role.value.replace("_", " "), one.endpoint.name)
            found.setdefault(key, set()).add(_end(one))
        for parameter in node.parameters:
            if parameter.access or parameter.set_by is not None:
                found.setdefault(("parameter", parameter.name), set()).add(
                    "unknown" if parameter.value is None else f'"{parameter.value}"'
                )
        for remap in node.remaps:
            found.setdefault(("remapping", remap.source), set()).add(remap.target)
    return {key: "; ".join(sorted(texts)) for key, texts in found.items()}


def _end(one: ConfiguredEndpoint) -> str:
    quality = quality_text(one.endpoint.qos) if one.endpoint.qos else ""
    queue = f"queue {one.queue}" if one.queue >= 0 else ""
    conditions = [f"if {condition}" for condition in one.conditions]
    words = [one.endpoint.type or "type unknown", quality, queue, "latched" if one.latched else "", *conditions]
    return ", ".join(word for word in words if word)


def _outside(configuration: Configuration) -> _Facts:
    return {("parameter", one.name): f'"{one.value}"' for one in configuration.parameters}


def _told(node: str, before: _Facts, after: _Facts) -> Iterator[Difference]:
    for key in sorted(before.keys() | after.keys()):
        one, two = before.get(key), after.get(key)
        if one != two:
            how = "added" if one is None else "removed" if two is None else "changed"
            yield Difference(node, *key, how, one or "", two or "")


def to_text(found: Sequence[Difference], before: str, after: str) -> str:
    """Return differences as lines, by node."""
    lines = [f"--- {before}", f"+++ {after}"]
    node = None
    for one in found:
        if one.what == "node" and not one.name:
            lines.append(f"{_SIGNS[one.how]} {one.node}  {one.before or one.after}")
            node = one.node
            continue
        if one.node != node:
            node = one.node
            lines.append(f"  {node or 'parameters of all nodes'}")
        lines.append(f"{_SIGNS[one.how]}   {one.what} {one.name}: {_change(one)}")
    if not found:
        lines.append("no difference")
    return "\n".join(lines) + "\n"


def _change(one: Difference) -> str:
    return f"{one.before} -> {one.after}" if one.how == "changed" else one.before or one.after


def to_markdown(found: Sequence[Difference], before: str, after: str) -> str:
    """Return differences as a table for a pull request."""
    head = f"**Computation graph**: `{_cell(before)}` to `{_cell(after)}`"
    if not found:
        return f"{head}: no difference\n"
    count = {how: sum(one.how == how for one in found) for how in _SIGNS}
    told = ", ".join(f"{number} {how}" for how, number in count.items() if number)
    lines = [f"{head}: {told}", "", "| | node | what | before | after |", "| --- | --- | --- | --- | --- |"]
    for one in found:
        what = f"{one.what} {_code(one.name)}" if one.name else one.what
        lines.append(f"| {one.how} | {_code(one.node)} | {what} | {_code(one.before)} | {_code(one.after)} |")
    return "\n".join(lines) + "\n"


def _code(text: str) -> str:
    return f"`{_cell(text)}`" if text else ""


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|").replace("`", "'")
