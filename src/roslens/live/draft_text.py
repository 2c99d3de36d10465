"""A drafted reference as YAML, each line with what speaks for it."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence

from roslens.judge.amount import Limits, amount_text, limits_text
from roslens.judge.range import plain
from roslens.live.draft import Drafted, Line
from roslens.live.draft_groups import pattern_of
from roslens.live.signals import BY_KEY

_PLAIN = re.compile(r"[A-Za-z/~_][A-Za-z0-9_/.-]*\Z")
_YAML_WORDS = frozenset({"true", "false", "yes", "no", "on", "off", "null", "y", "n"})


def draft_text(name: str, drafts: Sequence[Drafted], left_out: Iterable[str], source: str) -> str:
    """Return the document; ``source`` says in words what was observed."""
    lines = [
        f"# Drafted from {source}. Read it, change it, then take this line away.",
        "kind: reference",
        f"name: {name}",
        f"title: {json.dumps(f'Drafted from {source}', ensure_ascii=False)}",
        "constraints:" if drafts else "constraints: []",
    ]
    for one in drafts:
        lines += _constraint(one)
    ignored = sorted(left_out)
    if ignored:
        lines.append("# Too few messages to say anything of:")
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
    return lines


def _evidence(line: Line, unit: str) -> str:
    typical = amount_text(float(f"{line.typical:.3g}"), unit)
    word = "about" if line.outside else "at most"
    rate = f"{word} {plain(float(f'{line.alarms_per_hour:.2g}'))} alarms an hour"
    return f"typically {typical}; {line.outside} of {line.windows} windows outside: {rate}"


def _scalar(text: str) -> str:
    plain = _PLAIN.match(text) and text.lower() not in _YAML_WORDS
    return text if plain else json.dumps(text, ensure_ascii=False)


def _in_comment(text: str) -> str:
    return "".join(one if one.isprintable() else "?" for one in text)
