"""A configuration for Graphviz: namespaces as boxes, nodes as ellipses, topics as boxes.

Dashed is conditional, dotted unresolved; services are hexagons, actions octagons, notes what no known program starts.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from roslens.model.configuration import Configuration
from roslens.report.graph.graph_edges import Drawn, Line, namespace_of, things_of
from roslens.report.graph.unstarted_text import unstarted_packages
from roslens.report.writing.control_characters import shown_controls

_SHAPES = {"node": "ellipse", "topic": "box", "service": "hexagon", "action": "octagon"}


def to_dots(configurations: Sequence[Configuration]) -> str:
    """Return configurations; what no known program starts stands as notes beside the first of its version of ROS."""
    loose = [one for one in configurations if one.unstarted]
    texts = []
    for one in configurations:
        if not one.unstarted:
            texts.append(to_dot(one, [each for each in loose if each.generation == one.generation]))
            loose = [each for each in loose if each.generation != one.generation]
    texts += [to_dot(Configuration(each.title, each.generation), [each]) for each in loose]
    return "\n".join(texts)


def to_dot(configuration: Configuration, unstarted: Sequence[Configuration] = ()) -> str:
    """Return a configuration in the language of Graphviz.

    Args:
        configuration: what would run.
        unstarted: what no known program starts: a note for each package.
    """
    drawn, lines = things_of(configuration)
    notes = [(package, lines) for one in unstarted for package, lines in unstarted_packages(one)]
    return "\n".join(_lines(configuration.title, drawn, lines, notes)) + "\n"


def _lines(
    title: str, drawn: tuple[Drawn, ...], lines: tuple[Line, ...], notes: Sequence[tuple[str, list[str]]]
) -> Iterator[str]:
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
    if notes:
        yield f"  subgraph {_quoted('cluster started by no known program')} {{"
        yield '    label="started by no known program"; style=dashed;'
        for package, reported in notes:
            text = "".join(_quoted(line)[1:-1] + "\\l" for line in (package, *reported))
            yield f'    {_quoted(f"unstarted {package}")} [shape=note, label="{text}"];'
        yield "  }"
    yield "}"


def _drawn(one: Drawn) -> str:
    style = "dotted" if not one.resolved else "dashed" if one.conditional else ""
    styled = f", style={style}" if style else ""
    return f"{_quoted(f'{one.kind} {one.name}')} [label={_quoted(one.name)}, shape={_SHAPES[one.kind]}{styled}];"


def _style(*, resolved: bool, conditional: bool) -> str:
    style = "dotted" if not resolved else "dashed" if conditional else ""
    return f" [style={style}]" if style else ""


def _quoted(text: str) -> str:
    return '"' + shown_controls(text.replace("\n", " ")).replace("\\", "\\\\").replace('"', '\\"') + '"'
