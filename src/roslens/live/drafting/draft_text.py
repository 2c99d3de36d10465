"""A drafted reference as YAML, each line with what speaks for it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence

from roslens.judge.ranges.amount import Limits, amount_text, limits_text
from roslens.judge.ranges.range import plain
from roslens.live.drafting.draft import Drafted
from roslens.live.drafting.draft_groups import escaped, pattern_of
from roslens.live.drafting.draft_lines import Line
from roslens.live.drafting.draft_presence import PLUMBING, There
from roslens.live.window.signals import BY_KEY

LASTING_S = 2.0
"""What lasts shorter is a hiccup of the network or of the recorder."""
MARGIN_PERCENT = 5
"""Of a bound, so that what wavers around it is one alarm."""

_PLAIN = re.compile(r"[A-Za-z/~_][A-Za-z0-9_/.-]*\Z")
_YAML_WORDS = frozenset({"true", "false", "yes", "no", "on", "off", "null", "y", "n"})


def draft_text(
    name: str,
    drafts: Sequence[Drafted],
    left_out: Iterable[str],
    source: str,
    there: Sequence[There] = (),
    unsteady: Sequence[str] = (),
    raised: Sequence[str] = (),
) -> str:
    """Return the document.

    Args:
        name: of the reference.
        drafts: what is proposed of topics.
        left_out: topics of which too little was seen.
        source: what was observed, in words.
        there: what is proposed to be there always; of topics with values that goes without saying.
        unsteady: nodes that came or went, or whose names another start would not make again.
        raised: the alarms that the draft raises on what it was drafted from, in words.
    """
    rated = [one for one in drafts if one.lines]
    valued = {topic for one in rated for topic in one.names}
    always = [one for one in there if one.kind == "node" or one.name not in valued]
    # Of what was watched it is known whether it was always there; a recording has its topics from the beginning.
    eventful = [one for one in drafts if not one.lines and not there]
    lines = [
        f"# Drafted from {source}. Read it, change it, then take this line away.",
        "kind: reference",
        f"name: {name}",
        f"title: {json.dumps(f'Drafted from {source}', ensure_ascii=False)}",
    ]
    if rated:
        lines.append(f"defaults: {{for: {amount_text(LASTING_S, 's')}, margin: {plain(MARGIN_PERCENT)} %}}")
    lines.append("constraints:" if rated or eventful or always else "constraints: []")
    for one in rated:
        lines += _constraint(one)
    for one in eventful:
        lines += _events(one)
    for present in always:
        lines += _presence(present)
    present_topics = {one.name for one in always if one.kind == "topic"}
    absent = [one for one in drafts if not one.lines and one not in eventful and one.names[0] not in present_topics]
    if absent:
        lines.append("# Topics that come with events and were not always there:")
        lines += [f"#   {_in_comment(one.names[0])}: {one.unsteady}" for one in absent]
    if unsteady:
        lines.append("# Nodes that came or went, or whose names another start would not make again:")
        lines += [f"#   {_in_comment(node)}" for node in unsteady]
    if raised:
        lines.append("# On what it was drafted from it raises:")
        lines += [f"#   {_in_comment(alarm)}" for alarm in raised]
    ignored = sorted({*left_out} - present_topics - PLUMBING)
    if ignored:
        lines.append("# Too few messages for a constraint:")
        lines += [f"#   {_in_comment(topic)}" for topic in ignored]
    return "\n".join(lines) + "\n"


def _constraint(one: Drafted) -> list[str]:
    several = f"{len(one.names)} topics, " if len(one.names) > 1 else ""
    lines = [
        f"  # {several}{one.messages:,} messages in {amount_text(round(one.seconds, 1), 's')}",
        f"  - topic: {_scalar(pattern_of(one.names))}",
    ]
    if one.type:
        lines.append(f"    type: {_scalar(one.type)}")
    for line in one.lines:
        unit = BY_KEY[line.quantity].unit
        lines.append(f"    {line.quantity}: {limits_text(Limits(line.range), unit)}  # {_evidence(line, unit)}")
    return [*lines, f"    window: {amount_text(one.window, 's')}"]


def _events(one: Drafted) -> list[str]:
    """Return that something is there that comes with events."""
    lines = [
        f"  # {one.messages:,} messages in {amount_text(round(one.seconds, 1), 's')}, no steady rate: {one.unsteady}",
        f"  - topic: {_scalar(escaped(one.names[0]))}",
    ]
    return [*lines, *([f"    type: {_scalar(one.type)}"] if one.type else []), "    expected: always"]


def _presence(one: There) -> list[str]:
    lines = [f"  - {one.kind}: {_scalar(escaped(one.name))}"]
    if one.type:
        lines.append(f"    type: {_scalar(one.type)}")
    evidence = "in the graph; how often it is not cannot be known from that"
    if one.hours:
        word = "about" if one.losses else "at most"
        rate = f"{word} {plain(float(f'{one.alarms_per_hour:.2g}'))} alarms an hour"
        evidence = f"there at {one.seen} of {one.looks} looks, lost {one.losses} times: {rate}"
    return [*lines, f"    expected: always  # {evidence}"]


def _evidence(line: Line, unit: str) -> str:
    typical = amount_text(float(f"{line.typical:.3g}"), unit)
    word = "about" if line.outside else "at most"
    rate = f"{word} {plain(float(f'{line.alarms_per_hour:.2g}'))} alarms an hour"
    times = f"{line.outside} time{'s' if line.outside != 1 else ''}"
    return f"typically {typical}; outside {times} in {amount_text(round(line.hours * 3600), 's')}: {rate}"


def _scalar(text: str) -> str:
    plain = _PLAIN.match(text) and text.lower() not in _YAML_WORDS
    return text if plain else json.dumps(text, ensure_ascii=False)


def _in_comment(text: str) -> str:
    return "".join(one if one.isprintable() else "?" for one in text)
