"""A configuration as a Mermaid flowchart, which forges draw in Markdown: nodes round, topics square.

Dotted lines are conditional or unresolved; services are hexagons, actions stadiums.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roslens.model.configuration import Configuration
from roslens.report.graph.graph_edges import Drawn, namespace_of, things_of
from roslens.report.writing.control_characters import shown_controls

_SHAPES = {"node": ("((", "))"), "topic": ("[", "]"), "service": ("{{", "}}"), "action": ("([", "])")}
_ESCAPES = {'"': "#quot;", "<": "#lt;", ">": "#gt;", "&": "#amp;", "#": "#35;"}


def to_mermaid(configuration: Configuration) -> str:
    """Return a configuration as a flowchart."""
    return "\n".join(_lines(configuration)) + "\n"


def _lines(configuration: Configuration) -> Iterator[str]:
    drawn, lines = things_of(configuration)
    names = {(one.kind, one.name): f"{one.kind[0]}{number}" for number, one in enumerate(drawn)}
    yield "flowchart LR"
    yield from _nodes([one for one in drawn if one.kind == "node"], names)
    for one in drawn:
        if one.kind != "node":
            yield f"  {_drawn(one, names)}"
    for line in lines:
        node, thing = names["node", line.node], names[line.kind, line.thing]
        first, second = (node, thing) if line.out else (thing, node)
        arrow = "-.->" if line.conditional or not line.resolved else "-->"
        yield f"  {first} {arrow} {second}"


def _nodes(nodes: Sequence[Drawn], names: dict[tuple[str, str], str]) -> Iterator[str]:
    """Yield the nodes by namespaces, each of which but the root is a box."""
    for number, namespace in enumerate(sorted({namespace_of(one.name) for one in nodes})):
        boxed = namespace != "/"
        if boxed:
            yield f'  subgraph g{number}["{_escaped(namespace)}"]'
        for one in nodes:
            if namespace_of(one.name) == namespace:
                yield f"  {_drawn(one, names)}"
        if boxed:
            yield "  end"


def _drawn(one: Drawn, names: dict[tuple[str, str], str]) -> str:
    opening, closing = _SHAPES[one.kind]
    return f'{names[one.kind, one.name]}{opening}"{_escaped(one.name)}"{closing}'


def _escaped(text: str) -> str:
    return "".join(_ESCAPES.get(sign, sign) for sign in shown_controls(" ".join(text.split())))
