"""The nodes of a configuration as command lines that start each alone: ``ros2 run``, ``ros2 component``, ``rosrun``.

A line has the name, remappings and parameters that a launch file sets; what of these cannot be known without running is
left in a comment above it, and a line that cannot be stated at all is a comment itself.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Sequence
from itertools import groupby

from roslens.model.configuration import Configuration, ConfiguredNode
from roslens.report.graph.set_parameter import listed, set_value, unknown_reason


def to_commands(configuration: Configuration) -> str:
    """Return a configuration as lines of a shell."""
    return "".join(f"{line}\n" for line in _lines(configuration))


def _lines(configuration: Configuration) -> Iterator[str]:
    yield f"# {_comment(configuration.title)}"
    ros1 = configuration.generation == "ros1"
    # A component is loaded into what runs already.
    nodes = sorted(configuration.nodes, key=lambda one: (bool(one.container), one.proof, one.executable))
    for _, group in groupby(nodes, key=lambda one: (one.proof, one.package, one.executable, one.container)):
        yield from _command(tuple(group), ros1=ros1)


def _command(nodes: Sequence[ConfiguredNode], *, ros1: bool) -> Iterator[str]:
    """Yield the line that starts nodes of one program, below comments about what it lacks."""
    first = nodes[0]
    named = ", ".join(one.name for one in nodes)
    if first.kind == "process" or not first.package or not first.executable:
        yield f"# {_comment(named)}: what starts it is no program of a package ({_comment(first.proof.place)})"
        return
    if any(clause for one in nodes for clause in one.conditions):
        yield f"# {_comment(named)}: only if {_comment(' and '.join(first.conditions))}"
    words = _ros1(nodes) if ros1 else _component(first) if _is_loaded(first) else _program(nodes)
    yield from (f"# {_comment(one.name)}: {_comment(text)}" for one in nodes for text in _lacking(one))
    line = shlex.join(words)
    yield f"# {line}" if any("*" in word for word in words[:4]) else line


def _is_loaded(node: ConfiguredNode) -> bool:
    return bool(node.container) and node.kind == "component"


def _program(nodes: Sequence[ConfiguredNode]) -> list[str]:
    words = ["ros2", "run", nodes[0].package, nodes[0].executable]
    arguments: list[str] = []
    alone = len(nodes) == 1
    for one in nodes:
        if alone and one.resolved and not one.anonymous:
            space, name = _split(one.name)
            arguments += ["-r", f"__node:={name}"] + (["-r", f"__ns:={space}"] if space != "/" else [])
        # A program with several nodes takes each rule and value for the node that is named before it.
        before = "" if alone else f"{_split(one.name)[1]}:"
        arguments += [word for rule in _remaps(one) for word in ("-r", f"{before}{rule}")]
        arguments += [word for name, value in _set(one) for word in ("-p", f"{before}{name}:={value}")]
    return [*words, "--ros-args", *arguments] if arguments else words


def _component(node: ConfiguredNode) -> list[str]:
    space, name = _split(node.name)
    words = ["ros2", "component", "load", node.container, node.package, node.executable]
    if node.resolved:
        words += ["--node-name", name] + (["--node-namespace", space] if space != "/" else [])
    words += [word for rule in _remaps(node) for word in ("-r", rule)]
    return words + [word for name, value in _set(node) for word in ("-p", f"{name}:={value}")]


def _ros1(nodes: Sequence[ConfiguredNode]) -> list[str]:
    first = nodes[0]
    space, name = _split(first.name)
    if first.kind == "nodelet" and first.container:
        words = ["rosrun", "nodelet", "nodelet", "load", first.executable, first.container]
    else:
        words = ["rosrun", first.package, first.executable]
    if first.resolved and not first.anonymous and len(nodes) == 1:
        words += [f"__name:={name}"] + ([f"__ns:={space}"] if space != "/" else [])
    for one in nodes:
        words += _remaps(one)
        below = f"{one.name}/"
        words += [f"_{key.removeprefix(below)}:={value}" for key, value in _set(one) if key.startswith(below)]
    return words


def _split(name: str) -> tuple[str, str]:
    space, _, last = name.rpartition("/")
    return space or "/", last


def _remaps(node: ConfiguredNode) -> Iterator[str]:
    for one in node.remaps:
        if not one.uncertain and "*" not in one.target:
            yield f"{one.source}:={one.target}"


def _set(node: ConfiguredNode) -> Iterator[tuple[str, str]]:
    for one in listed(node):
        value = set_value(one) if one.set_by is not None else None
        if value is not None:
            yield one.name, value


def _lacking(node: ConfiguredNode) -> Iterator[str]:
    """Yield what is set for a node and cannot be stated."""
    for one in listed(node):
        if one.set_by is not None and set_value(one) is None:
            yield f"parameter {one.name} is not in the line: {unknown_reason(one)}"
    for remap in node.remaps:
        if remap.uncertain or "*" in remap.target:
            yield f"remapping {remap.source} to {remap.target} is not in the line: a part of it is unknown"


def _comment(text: str) -> str:
    return " ".join(text.split())
