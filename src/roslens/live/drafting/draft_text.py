"""A drafted reference as YAML, each line with what speaks for it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence

import msgspec

from roslens.judge.ranges.amount import Limits, amount_text, limits_text
from roslens.judge.ranges.range import plain
from roslens.live.drafting.draft import Drafted
from roslens.live.drafting.draft_bounds import WINDOW, Bound
from roslens.live.drafting.draft_groups import escaped, pattern_of
from roslens.live.drafting.draft_lines import Line, expected_alarms
from roslens.live.drafting.draft_presence import PLUMBING, There
from roslens.live.drafting.draft_states import Kept
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityKind
from roslens.model.words.plural import plural

LASTING_S = 2.0
"""What lasts shorter is a hiccup of the network or of the recorder."""
MARGIN_PERCENT = 5
"""Of a bound, so that what wavers around it is one alarm."""

_PLAIN = re.compile(r"([A-Za-z/~_][A-Za-z0-9_/.-]*|-?[0-9]+(\.[0-9]+)?)\Z")
_YAML_WORDS = frozenset({"true", "false", "yes", "no", "on", "off", "null", "y", "n"})
_EXACT = ("publishers", "misfits")
"""What is derived from the graph, and judged in no window."""


class Beside(msgspec.Struct, frozen=True):
    """What is proposed beside rates and gaps.

    Attributes:
        there: to be there always; of topics with values that goes without saying.
        bounds: of what was measured once a second.
        kept: states and parameters to stay as they are.
    """

    there: tuple[There, ...] = ()
    bounds: tuple[Bound, ...] = ()
    kept: tuple[Kept, ...] = ()


class _Block:
    """One constraint of the document: comments, what it selects, and its lines, some of them commented out."""

    def __init__(self, kind: str, pattern: str, type_: str = "") -> None:
        self.kind, self.pattern = kind, pattern
        self.type = type_
        self.comments: list[str] = []
        self.lines: list[str] = []
        self.left_out: list[str] = []
        self.window = 0.0

    def text(self) -> list[str]:
        """Return its lines; where all of them are commented out, so is what it selects."""
        inner = [f"  - {self.kind}: {_scalar(self.pattern)}"]
        inner += [f"    type: {_scalar(self.type)}"] if self.type else []
        inner += [f"    {one}" for one in self.lines]
        inner += [f"    window: {amount_text(self.window, 's')}"] if self.window and self.lines else []
        if not self.lines:
            inner = [f"  # {one.removeprefix('  ')}" for one in inner]
            return [*(f"  # {one}" for one in self.comments), *inner, *(f"  #   {one}" for one in self.left_out)]
        return [*(f"  # {one}" for one in self.comments), *inner, *(f"    # {one}" for one in self.left_out)]


class _Blocks:
    """The constraints of the document in their order; what is about the same entity is one."""

    def __init__(self) -> None:
        self._blocks: dict[tuple[str, str], _Block] = {}

    def of(self, kind: str, pattern: str, type_: str = "") -> _Block:
        """Return the constraint on what a pattern matches."""
        block = self._blocks.setdefault((kind, pattern), _Block(kind, pattern))
        block.type = block.type or type_
        return block

    def text(self) -> list[str]:
        """Return all of them, first those of which a line is not commented out."""
        kept = sorted(self._blocks.values(), key=lambda one: not one.lines)
        return [line for one in kept for line in one.text()]

    @property
    def any(self) -> bool:
        """Whether something is required."""
        return any(one.lines for one in self._blocks.values())


def draft_text(
    name: str,
    drafts: Sequence[Drafted],
    left_out: Iterable[str],
    source: str,
    beside: Beside = Beside(),  # noqa: B008 - frozen
    unsteady: Sequence[str] = (),
    raised: Sequence[str] = (),
) -> str:
    """Return the document.

    Args:
        name: of the reference.
        drafts: what is proposed of topics.
        left_out: topics of which too little was seen.
        source: what was observed, in words.
        beside: what is proposed beside rates and gaps.
        unsteady: nodes that came or went, or whose names another start would not make again.
        raised: the alarms that the draft raises on what it was drafted from, in words.
    """
    there = beside.there
    rated = [one for one in drafts if one.rated]
    valued = {topic for one in rated for topic in one.names}
    always = [one for one in there if one.kind != "topic" or one.name not in valued]
    # Of what was watched it is known whether it was always there; a recording has its topics from the beginning.
    eventful = [one for one in drafts if not one.rated and not there]
    blocks = _Blocks()
    for one in rated:
        _rated(blocks, one)
    for one in eventful:
        _events(blocks, one)
    for present in always:
        _presence(blocks, present)
    present_topics = {one.name for one in always if one.kind == "topic"}
    for one in drafts:
        if not one.rated and (one in eventful or one.names[0] in present_topics):
            blocks.of("topic", escaped(one.names[0])).left_out += _ranges(one)
    _kept(blocks, beside.kept)
    _bounds(blocks, beside.bounds)
    lines = [
        f"# Drafted from {source}. Read it, change it, then take this line away.",
        "kind: reference",
        f"name: {name}",
        f"title: {json.dumps(f'Drafted from {source}', ensure_ascii=False)}",
    ]
    if rated or beside.bounds:
        lines.append(f"defaults: {{for: {amount_text(LASTING_S, 's')}, margin: {plain(MARGIN_PERCENT)} %}}")
    lines.append("constraints:" if blocks.any else "constraints: []")
    lines += blocks.text()
    absent = [one for one in drafts if not one.rated and one not in eventful and one.names[0] not in present_topics]
    lines += _listed(
        "Topics that come with events and were not always there", [f"{one.names[0]}: {one.unsteady}" for one in absent]
    )
    lines += _listed("Nodes that came or went, or whose names another start would not make again", unsteady)
    lines += _listed("On what it was drafted from it raises", raised)
    lines += _listed("Too few messages for a constraint", sorted({*left_out} - present_topics - PLUMBING))
    return "\n".join(lines) + "\n"


def _listed(title: str, texts: Sequence[str]) -> list[str]:
    return [f"# {title}:", *(f"#   {_in_comment(one)}" for one in texts)] if texts else []


def _rated(blocks: _Blocks, one: Drafted) -> None:
    block = blocks.of("topic", pattern_of(one.names), one.type)
    several = f"{len(one.names)} topics, " if len(one.names) > 1 else ""
    block.comments.append(f"{several}{one.messages:,} messages in {amount_text(round(one.seconds, 1), 's')}")
    block.window = one.window
    block.lines += _ranges(one)


def _ranges(one: Drafted) -> list[str]:
    units = [BY_KEY[line.quantity].unit for line in one.lines]
    return [
        f"{line.quantity}: {limits_text(Limits(line.range), unit)}  # {_evidence(line, unit)}"
        for line, unit in zip(one.lines, units, strict=True)
    ]


def _events(blocks: _Blocks, one: Drafted) -> None:
    """Add that something is there that comes with events."""
    block = blocks.of("topic", escaped(one.names[0]), one.type)
    seconds = amount_text(round(one.seconds, 1), "s")
    word = "judged by presence" if one.lines else "no steady rate"
    block.comments.append(f"{one.messages:,} messages in {seconds}, {word}: {one.unsteady}")
    block.lines.append("expected: always")


def _presence(blocks: _Blocks, one: There) -> None:
    evidence = "in the graph; how often it is not cannot be known from that"
    if one.hours:
        evidence = f"there at {one.seen} of {one.looks} looks, lost {one.losses} times: {_rate(one.losses, one.hours)}"
    blocks.of(one.kind, escaped(one.name), one.type).lines.append(f"expected: always  # {evidence}")


def _kept(blocks: _Blocks, kept: Iterable[Kept]) -> None:
    for one in kept:
        block = blocks.of(one.entity.kind.value, escaped(one.entity.name))
        key = "lifecycle" if one.entity.kind is EntityKind.NODE else "value"
        # A bare true is a truth value in YAML, and the text of a parameter that is one.
        line = f"{key}: {one.value if one.value in ('true', 'false') else _scalar(one.value)}"
        changes = plural(one.changes, "time")
        evidence = f"at {one.looks} looks, changed {changes}: {_rate(one.changes, one.hours)}"
        if one.changes:
            block.left_out.append(f"{line}  # not steady: {evidence}")
        else:
            block.lines.append(f"{line}  # {evidence}")


def _bounds(blocks: _Blocks, bounds: Iterable[Bound]) -> None:
    for one in bounds:
        unit = BY_KEY[one.quantity].unit
        line = f"{one.quantity}: {_limits(one, unit)}"
        block = blocks.of(one.entity.kind.value, escaped(one.entity.name))
        if one.unsteady:
            block.left_out.append(f"{line}  # not steady: {one.unsteady}")
            continue
        block.lines.append(f"{line}  # {_evidence(one, unit)}")
        if one.quantity not in _EXACT:
            block.window = block.window or float(WINDOW)


def _limits(one: Bound, unit: str) -> str:
    low, high = one.range.minimum, one.range.maximum
    return plain(low) if low is not None and low == high else limits_text(Limits(one.range), unit)


def _evidence(line: Line | Bound, unit: str) -> str:
    typical = amount_text(float(f"{line.typical:.3g}"), unit)
    times = plural(line.outside, "time")
    seconds = amount_text(round(line.hours * 3600), "s")
    return f"typically {typical}; outside {times} in {seconds}: {_rate(line.outside, line.hours)}"


def _rate(times: int, hours: float) -> str:
    """Return expected alarms an hour in words."""
    return f"{'about' if times else 'at most'} {plain(float(f'{expected_alarms(times, hours):.2g}'))} alarms an hour"


def _scalar(text: str) -> str:
    plain = _PLAIN.match(text) and text.lower() not in _YAML_WORDS
    return text if plain else json.dumps(text, ensure_ascii=False)


def _in_comment(text: str) -> str:
    return "".join(one if one.isprintable() else "?" for one in text)
