"""The computation graph of a configuration as one SVG picture that needs neither browser nor script."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from xml.sax.saxutils import escape, quoteattr

from roslens.dashboard.computation.noise import DEFAULT, PRESETS
from roslens.dashboard.computation.picture import Drawing, Left, Line, Mark, computation_graph, style_of
from roslens.dashboard.computation.system import Element, Kind, System
from roslens.dashboard.plan.ground import Box
from roslens.dashboard.render import WEB
from roslens.model.configuration import Configuration
from roslens.model.finding import Finding
from roslens.model.words.plural import plural
from roslens.report.graph.unstarted_text import unstarted_packages

_RULES = (
    (".paper", "fill", "ground"),
    (".box", "fill", "raised"),
    (".box", "stroke", "rule-strong"),
    (".d1", "fill", "sunken"),
    (".d2", "fill", "ground"),
    (".title,.said", "fill", "quiet"),
    (".title", "stroke", "raised"),
    (".wire", "stroke", "wire"),
    (".outline", "stroke", "disc-edge"),
    (".node .outline", "fill", "ground"),
    (".topic .outline", "fill", "topic"),
    (".service .outline", "fill", "service"),
    (".action .outline", "fill", "action"),
    (".name", "fill", "ink"),
    (".name", "stroke", "ground"),
    (".sure circle", "fill", "ground"),
    (".sure circle,.asked", "stroke", "ink"),
    (".half", "fill", "ink"),
    (".error", "fill", "error"),
    (".warning", "fill", "warning"),
)
_SHAPE = """
text{font:12px system-ui,"Segoe UI",Roboto,"Noto Sans","Liberation Sans",Arial,sans-serif}
.box{stroke-width:1}.title{font-weight:600;paint-order:stroke;stroke-width:3px}
.wire{fill:none;stroke-width:1.1}.outline{stroke-width:1.4}.name{paint-order:stroke;stroke-width:3px}
.node .name{text-anchor:middle;stroke:none}.many .wire{stroke-width:.8}.mark{font-weight:700}
.conditional{stroke-dasharray:6 4}.unresolved{stroke-dasharray:1.5 3.5;stroke-linecap:round}
.conditional>.outline{stroke-dasharray:3 2}.unresolved>.outline{stroke-dasharray:1.5 3.5;stroke-linecap:round}
.sure{stroke-dasharray:none}.asked{fill:none;stroke-linecap:round}.sure circle,.asked{stroke-width:1.2}
"""
_COLOUR = re.compile(r"--([\w-]+): (#[0-9a-f]{6});")
_FORBIDDEN = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_SIGN = {"error": "\N{HEAVY MULTIPLICATION X}", "warning": "\N{BLACK UP-POINTING TRIANGLE}"}
_BASELINE = 4
"""How far below the middle of a line the foot of its letters is."""

_CHARACTER = 6.3
_FOOT = 76
_MOST_LISTED = 60
_LEGEND = (("node", 34), ("topic", 34), ("service", 42), ("action", 36))


def to_svg(
    configuration: Configuration,
    findings: Sequence[Finding] = (),
    *,
    everything: bool = False,
    unstarted: Sequence[Configuration] = (),
) -> str:
    """Return the picture: a box for each namespace, dashed what depends on a condition, dotted what is not resolved.

    Args:
        configuration: what would run.
        findings: about it; elements that have some are marked by the worst.
        everything: whether also what is the same in every system is drawn.
        unstarted: what no known program starts: a list below the picture.
    """
    system = System("picture", configuration, findings)
    left = Left(frozenset()) if everything else Left()
    graph = computation_graph(system, left)
    drawing, lines = (graph.lines, graph.flows) if graph.many else (graph.topics, graph.wires)
    captions = [*_captions(system, drawing, as_lines=graph.many)]
    first = len(captions)
    captions += _unstarted(unstarted)
    width = max(drawing.width, 960.0, 32 + max(map(len, captions)) * _CHARACTER)
    height = drawing.height + _FOOT + 17 * max(0, len(captions) - first)
    size = f'width="{width:g}" height="{height:g}"'
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" {size} viewBox="0 0 {width:g} {height:g}" role="img">',
        f"<title>{_text(configuration.title)}</title>",
        f"<style>{_style()}</style>",
        f'<rect class="paper" {size}/>',
        *(_box(box) for box in drawing.boxes),
        f'<g class="wires{" many" if len(drawing.lines) > 200 else ""}">',
        *(_wire(lines[number], path, system) for number, path in drawing.lines),
        "</g>",
        *(_title(box) for box in drawing.boxes),
        *(_element(system.elements[at], graph.marks[at], place) for at, place in sorted(drawing.places.items())),
        *_legend(drawing.height, captions),
        "</svg>",
    ]
    return "\n".join(parts) + "\n"


def _unstarted(found: Sequence[Configuration]) -> Iterator[str]:
    """Yield lines about what no known program starts, by package."""
    packages = [one for each in found for one in unstarted_packages(each)]
    if packages:
        yield "Started by no known program, so in no node of the picture:"
    lines = [line for package, nodes in packages for line in (package, *(f"\N{NO-BREAK SPACE} {one}" for one in nodes))]
    yield from lines[:_MOST_LISTED]
    if len(lines) > _MOST_LISTED:
        yield f"and {len(lines) - _MOST_LISTED} more lines, which roslens graph prints"


def _style() -> str:
    light, dark = palettes()

    def colours(palette: dict[str, str]) -> str:
        return "".join(f"{selector}{{{what}:{palette[name]}}}" for selector, what, name in _RULES)

    return f"{colours(light)}{_SHAPE}@media (prefers-color-scheme:dark){{{colours(dark)}.node .name{{stroke:none}}}}"


def palettes() -> tuple[dict[str, str], dict[str, str]]:
    """Return the colours of the pages by name, light and dark: the picture looks as they do."""
    text = (WEB / "roslens.css").read_text(encoding="utf-8")
    light, dark = text.split("@media (prefers-color-scheme: dark)", 1)
    dark = dark.partition("\n}\n")[0]
    first = dict(_COLOUR.findall(light))
    return first, {**first, **dict(_COLOUR.findall(dark))}


def _text(text: str) -> str:
    return escape(_FORBIDDEN.sub("\N{REPLACEMENT CHARACTER}", text))


def _box(box: Box) -> str:
    depth = min(box.depth, 2)
    return (
        f'<rect class="box d{depth}" x="{box.x:g}" y="{box.y:g}" width="{box.width:g}" height="{box.height:g}" rx="8"/>'
    )


def _title(box: Box) -> str:
    return f'<text class="title" x="{box.x + 7:g}" y="{box.y + 15:g}">{_text(box.title)}</text>'


def _wire(line: Line, path: str, system: System) -> str:
    # A line between nodes lists its topics and services; one to a topic needs no more words.
    by = "\n".join(system.elements[number].name for number in line.by)
    title = f"<title>{_text(by)}</title>" if by else ""
    return f'<path class={quoteattr(f"wire {style_of(line)}".strip())} d="{path}">{title}</path>'


def _element(element: Element, mark: Mark, place: tuple[float, float]) -> str:
    states = [("conditional", element.conditional), ("unresolved", not element.resolved)]
    classes = " ".join([mark.kind, *(word for word, held in states if held)])
    return "".join(
        (
            f'<g class="{classes}" transform="translate({place[0]:g} {place[1]:g})">',
            f"<title>{_text(_told(element))}</title>",
            _outline(mark),
            _name(mark),
            _doubt(mark),
            _severity(mark),
            "</g>",
        )
    )


def _told(element: Element) -> str:
    words = [
        "" if element.sure == "certain" else element.sure,
        "only under a condition" if element.conditional else "",
        "" if element.resolved else "name not resolved",
        element.severity,
    ]
    return "\n".join([f"{element.kind.value} {element.name}", *(word for word in words if word)])


def _outline(mark: Mark) -> str:
    x = -mark.w / 2
    if mark.kind == Kind.NODE.value:
        return f'<rect class="outline" x="{x:.1f}" y="{-mark.h / 2:g}" width="{mark.w:g}" height="{mark.h:g}" rx="9"/>'
    return _sign(mark.kind, x + 9)


def _sign(kind: str, x: float) -> str:
    if kind == Kind.SERVICE.value:
        return f'<rect class="outline" x="{x - 6:.1f}" y="-6" width="12" height="12"/>'
    if kind == Kind.ACTION.value:
        return f'<path class="outline" d="M{x - 8:.1f} 0l4 -7h8l4 7l-4 7h-8Z"/>'
    return f'<path class="outline" d="M{x - 8:.1f} 0L{x:.1f} -8L{x + 8:.1f} 0L{x:.1f} 8Z"/>'


def _name(mark: Mark) -> str:
    x = 0.0 if mark.kind == Kind.NODE.value else 20 - mark.w / 2
    return f'<text class="name" x="{x:.1f}" y="{_BASELINE}">{_text(mark.label)}</text>'


def _doubt(mark: Mark) -> str:
    if mark.sure == "certain":
        return ""
    node = mark.kind == Kind.NODE.value
    return _sure(mark.sure, mark.w / 2 if node else -mark.w / 2, -mark.h / 2 if node else 8)


def _sure(word: str, x: float, y: float) -> str:
    likely = '<path class="half" d="M0 -5A5 5 0 0 1 0 5Z"/>'
    asked = '<path class="asked" d="M-1.8 -1C-1.8 -3.6 2 -3.4 1.8 -1.2C1.6 0 0 0 0 1.2M0 2.8v.4"/>'
    sign = likely if word == "likely" else asked
    return f'<g class="sure" transform="translate({x:.1f} {y:g})"><circle r="5"/>{sign}</g>'


def _severity(mark: Mark) -> str:
    if mark.severity not in _SIGN:
        return ""
    x, y = -mark.w / 2 - 4, -mark.h / 2 + 4
    return f'<text class="mark {mark.severity}" x="{x:.1f}" y="{y:g}">{_SIGN[mark.severity]}</text>'


def _captions(system: System, drawing: Drawing, *, as_lines: bool) -> list[str]:
    counts = dict.fromkeys(Kind, 0)
    for number in drawing.places:
        counts[system.elements[number].kind] += 1
    amounts = ", ".join(plural(count, kind.value) for kind, count in counts.items() if count) or "no nodes"
    title = f"{system.configuration.title}: {amounts}"
    if as_lines:
        return [title, "Topics, services and actions are the lines between nodes."]
    hidden = len(system.elements) - len(drawing.places)
    quiet = ", ".join(preset.title for preset in PRESETS if preset.key in DEFAULT)
    return [title, f"{hidden} hidden: {quiet}"] if hidden else [title]


def _legend(top: float, captions: Sequence[str]) -> Iterator[str]:
    x, y = 24.0, top + 14
    for kind, wide in _LEGEND:
        yield f'<g class="{kind}" transform="translate({x:g} {y:g})">'
        yield (
            '<rect class="outline" x="-8" y="-6" width="16" height="12" rx="4"/>' if kind == "node" else _sign(kind, 0)
        )
        yield f'<text class="said" x="14" y="{_BASELINE}">{kind}</text></g>'
        x += wide + 36
    for word, text in (("conditional", "only under a condition"), ("unresolved", "name not resolved")):
        yield f'<path class="wire {word}" d="M{x:g} {y:g}h32"/>'
        yield f'<text class="said" x="{x + 38:g}" y="{y + _BASELINE:g}">{text}</text>'
        x += 38 + len(text) * _CHARACTER + 18
    for word in ("likely", "possible"):
        yield _sure(word, x, y)
        yield f'<text class="said" x="{x + 10:g}" y="{y + _BASELINE:g}">{word}</text>'
        x += 10 + len(word) * _CHARACTER + 18
    signs = "".join(f'<tspan class="mark {word}" dx="14">{sign}</tspan> {word}' for word, sign in _SIGN.items())
    yield f'<text class="said" x="{x - 20:g}" y="{y + _BASELINE:g}">{signs}</text>'
    for place, caption in enumerate(captions):
        yield f'<text class="said" x="16" y="{y + 30 + 17 * place:g}">{_text(caption)}</text>'
