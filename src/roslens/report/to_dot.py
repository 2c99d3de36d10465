"""A configuration for Graphviz: namespaces as boxes, nodes as ellipses, topics as boxes.

Dashed is conditional, dotted unresolved; services are hexagons, actions octagons.
"""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration
from roslens.report.graph_edges import Drawn, Line, namespace_of, things_of

_SHAPES = {"node": "ellipse", "topic": "box", "service": "hexagon", "action": "octagon"}


def to_dot(configuration: Configuration) -> str:
    """Return a configuration in the language of Graphviz."""
    drawn, lines = things_of(configuration)
    return "\n".join(_lines(configuration.title, drawn, lines)) + "\n"


def _lines(title: str, drawn: tuple[Drawn, ...], lines: tuple[Line, ...]) -> Iterator[str]:
    yield f"digraph {_quoted(title)} {{"
    yield "  rankdir=LR;"
    nodes = [one for one in drawn if one.kind == "node"]
    for namespace in sorted({namespace_of(one.name) for one in nodes}):
        inside = [one for one in nodes if namespace_of(one.name) == namespace]
        if namespace == "/":
            yield from (f"  {_drawn(one)}" for one in inside)
            continue
        yield f"  subgraph {_quoted('cluster ' + namespace)} {{"
        yield f"    label={_quoted(namespace)};"
        yield from (f"    {_drawn(one)}" for one in inside)
        yield "  }"
    yield from (f"  {_drawn(one)}" for one in drawn if one.kind != "node")
    for one in lines:
        node, thing = _quoted(f"node {one.node}"), _quoted(f"{one.kind} {one.thing}")
        way = f"{node} -> {thing}" if one.out else f"{thing} -> {node}"
        yield f"  {way}{_style(resolved=one.resolved, conditional=one.conditional)};"
    yield "}"


def _drawn(one: Drawn) -> str:
    style = "dotted" if not one.resolved else "dashed" if one.conditional else ""
    styled = f", style={style}" if style else ""
    return f"{_quoted(f'{one.kind} {one.name}')} [label={_quoted(one.name)}, shape={_SHAPES[one.kind]}{styled}];"


def _style(*, resolved: bool, conditional: bool) -> str:
    style = "dotted" if not resolved else "dashed" if conditional else ""
    return f" [style={style}]" if style else ""


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", " ") + '"'
