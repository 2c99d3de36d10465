"""What differs between source and what is there, drawn where the page of the source has it.

An element is as it is in source, not there, not in source, or differs; each of these is a sign and a word.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from enum import Enum

import msgspec

from roslens.compare.conformance.claim import NODE, PARAMETER, TOPIC
from roslens.compare.conformance.disparity import ABSENT, Aspect, Disparity
from roslens.compare.conformance.plumbing import plumbing
from roslens.compare.conformance.side import ENDPOINTS, Side
from roslens.dashboard.address import PageRef
from roslens.dashboard.computation.book import ref_of
from roslens.dashboard.computation.noise import DEFAULT, kinds_of_noise
from roslens.dashboard.computation.picture import Left, grounds_of, parts_in, visible_of
from roslens.dashboard.computation.system import KIND_OF_ROLE, OUTWARD, System
from roslens.dashboard.plan.ground import Box, Part, Wire
from roslens.dashboard.plan.mark import label_of, lane_of, namespace_of, part_of
from roslens.dashboard.plan.plan import drawn_on
from roslens.model.graph import Role


class Standing(str, Enum):
    """How an element stands to its source."""

    ALIKE = "alike"
    DIFFERS = "differs"
    MISSING = "missing"
    ADDED = "added"


SIGNS = {
    Standing.ALIKE: "",
    Standing.DIFFERS: "\N{NOT EQUAL TO}",
    Standing.MISSING: "\N{MINUS SIGN}",
    Standing.ADDED: "+",
}
WORDS = {
    Standing.ALIKE: "as in source",
    Standing.DIFFERS: "differs",
    Standing.MISSING: "not there",
    Standing.ADDED: "not in source",
}


class Element(msgspec.Struct, frozen=True):
    """A node, topic, service or action as drawn; ``differences`` lists its differences."""

    key: str
    kind: str
    name: str
    label: str
    w: float
    h: float
    x: float
    y: float
    standing: Standing
    differences: tuple[str, ...] = ()
    ref: PageRef | None = None


class Line(msgspec.Struct, frozen=True):
    """A line as drawn; ``about`` describes its ends, its topic and its state."""

    path: str
    standing: Standing
    about: str


class DifferencePicture(msgspec.Struct, frozen=True):
    """Everything that is drawn; ``as_lines`` where topics are lines between nodes."""

    width: float
    height: float
    boxes: tuple[Box, ...]
    elements: tuple[Element, ...]
    lines: tuple[Line, ...]
    as_lines: bool

    def count(self, standing: Standing) -> int:
        """Return how many elements stand so."""
        return sum(one.standing is standing for one in self.elements)


def difference_picture(
    system: System, disparities: Iterable[Disparity], others: Sequence[Side] = ()
) -> DifferencePicture:
    """Return the picture of a configuration and what differs from it.

    Args:
        system: as source has it.
        disparities: between it, the first side, and the others.
        others: what is there; they say what something that source does not know is joined to.
    """
    differences = _Differences(disparities)
    parts = parts_in(system)
    visible = visible_of(system, Left())
    keys = {number: parts[number].key for number in visible}
    wires = {
        (keys[wire.source], keys[wire.target]): _of_source(differences, keys[wire.source], keys[wire.target])
        for wire in system.wires
        if wire.source in visible and wire.target in visible and not wire.implicit
    }
    known = {parts[number].key for number in visible}
    wires |= _of_others(differences, known, others)
    there = {part.key: part for part in parts if part.key in known}
    lanes = {namespace_of(node.name) for node in system.nodes}
    for key in sorted({end for wire in wires for end in wire} | differences.added):
        if key not in there:
            name = key.partition(":")[2]
            there[key] = part_of(key, name, lane_of(name, lanes))
    standings = {key: _standing(differences, key, wires) for key in there}
    grounds = grounds_of(system)
    drawn = list(there.values())
    if grounds.many:
        drawn = [part for part in drawn if part.node]
        lines = _between_nodes(there, wires, standings)
    else:
        lines = {wire: (standing, "") for wire, standing in wires.items()}
    ends = sorted(lines)
    _, plan = drawn_on(grounds.lines if grounds.many else grounds.marks, drawn, ends)
    refs = {parts[number].key: ref_of(system, system.elements[number]) for number in visible}
    programs = {parts[number].key: system.elements[number].program for number in visible}
    elements = tuple(
        _element(part, place, standings[part.key], differences, refs.get(part.key), programs.get(part.key, ""))
        for part, place in zip(drawn, plan.places, strict=True)
    )
    shown = tuple(
        Line(path, lines[wire][0], _about(wire, *lines[wire])) for wire, path in zip(ends, plan.paths, strict=True)
    )
    return DifferencePicture(plan.width, plan.height, plan.boxes, elements, shown, grounds.many)


class _Differences:
    """The differences of each element and of its connections."""

    def __init__(self, disparities: Iterable[Disparity]) -> None:
        self.words: dict[str, list[str]] = {}
        self.differing: set[str] = set()
        self.missing: set[str] = set()
        self.added: set[str] = set()
        self.wires: dict[Wire, Standing] = {}
        for one in disparities:
            self._take(one)

    def _take(self, one: Disparity) -> None:
        standing = _of(one)
        how = WORDS[standing] if one.aspect is Aspect.PRESENCE else f"differs in {one.aspect.value}"
        text = f"{one.subject} {how}: {one.why}"
        if one.kind in (NODE, PARAMETER) or one.kind == TOPIC:
            key = f"{TOPIC}:{one.name}" if one.kind == TOPIC else f"{NODE}:{one.node}"
            self._mark(key, standing if one.kind != PARAMETER else Standing.DIFFERS)
            self.words.setdefault(key, []).append(text)
            return
        role = Role(one.kind)
        node, channel = f"{NODE}:{one.node}", f"{KIND_OF_ROLE[role].value}:{one.name}"
        wire = (node, channel) if role in OUTWARD else (channel, node)
        self.wires[wire] = standing
        if standing is Standing.DIFFERS:
            self.differing.add(channel)
        for key in (node, channel):
            self.words.setdefault(key, []).append(text)

    def _mark(self, key: str, standing: Standing) -> None:
        {Standing.MISSING: self.missing, Standing.ADDED: self.added}.get(standing, self.differing).add(key)


def _of(one: Disparity) -> Standing:
    if one.aspect is not Aspect.PRESENCE:
        return Standing.DIFFERS
    return Standing.ADDED if one.values[0] == ABSENT else Standing.MISSING


def _of_source(differences: _Differences, start: str, end: str) -> Standing:
    if {start, end} & differences.missing:
        return Standing.MISSING
    return differences.wires.get((start, end), Standing.ALIKE)


def _of_others(differences: _Differences, known: set[str], others: Sequence[Side]) -> dict[Wire, Standing]:
    """Return what nodes that source does not know are joined to, and what else is joined that is not in source."""
    found: dict[Wire, Standing] = {wire: one for wire, one in differences.wires.items() if one is Standing.ADDED}
    for side in others:
        for claim in side.claims:
            if claim.kind not in ENDPOINTS or plumbing(claim) or DEFAULT.intersection(kinds_of_noise(claim.name)):
                continue
            role = Role(claim.kind)
            node, channel = f"{NODE}:{claim.node}", f"{KIND_OF_ROLE[role].value}:{claim.name}"
            if node in differences.added and node not in known:
                found[(node, channel) if role in OUTWARD else (channel, node)] = Standing.ADDED
    return found


def _standing(differences: _Differences, key: str, wires: Mapping[Wire, Standing]) -> Standing:
    if key in differences.added:
        return Standing.ADDED
    if key in differences.missing:
        return Standing.MISSING
    joined = {standing for wire, standing in wires.items() if key in wire} if not key.startswith("node:") else set()
    # What joins nodes is there as long as one of them uses it.
    if joined == {Standing.MISSING}:
        return Standing.MISSING
    if joined == {Standing.ADDED}:
        return Standing.ADDED
    return Standing.DIFFERS if key in differences.differing else Standing.ALIKE


def _between_nodes(
    parts: Mapping[str, Part], wires: Mapping[Wire, Standing], standings: Mapping[str, Standing]
) -> dict[Wire, tuple[Standing, str]]:
    """Return a line for each pair of nodes between which something flows, with what that is."""
    giving: dict[str, list[str]] = {}
    taking: dict[str, list[str]] = {}
    for start, end in sorted(wires):
        if parts[start].node:
            giving.setdefault(end, []).append(start)
        else:
            taking.setdefault(start, []).append(end)
    found: dict[Wire, list[tuple[str, Standing]]] = {}
    for channel, sources in sorted(giving.items()):
        for source in sources:
            for target in taking.get(channel, ()):
                if source != target:
                    ends = {wires[source, channel], wires[channel, target], standings[channel]} - {Standing.ALIKE}
                    standing = _worst(ends)
                    found.setdefault((source, target), []).append((channel.partition(":")[2], standing))
    return {wire: (_of_several({one for _, one in by}), _names(by)) for wire, by in found.items()}


def _worst(found: set[Standing]) -> Standing:
    order = (Standing.MISSING, Standing.ADDED, Standing.DIFFERS)
    return next((one for one in order if one in found), Standing.ALIKE)


def _of_several(found: set[Standing]) -> Standing:
    return next(iter(found)) if len(found) == 1 else Standing.DIFFERS


def _names(by: Sequence[tuple[str, Standing]]) -> str:
    return ", ".join(name if one is Standing.ALIKE else f"{name} ({WORDS[one]})" for name, one in by)


def _about(wire: Wire, standing: Standing, by: str) -> str:
    start, end = (key.partition(":")[2] for key in wire)
    return f"{start} \N{RIGHTWARDS ARROW} {end}: {WORDS[standing]}{f'; {by}' if by else ''}"


def _element(
    part: Part,
    place: tuple[float, float],
    standing: Standing,
    differences: _Differences,
    ref: PageRef | None,
    program: str,
) -> Element:
    kind, _, name = part.key.partition(":")
    lane = "/" + "/".join(one for one in part.lane.split("/") if one and not one.startswith("@"))
    return Element(
        part.key, kind, name, label_of(name, lane, program), part.width, part.height, *place, standing,
        tuple(differences.words.get(part.key, ())), ref,
    )  # fmt: skip
