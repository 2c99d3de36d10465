"""Single findings for a terminal, whole: what to fix first, what is new, and every place of a grave rule."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

import msgspec

from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.result import RuleCount
from roslens.model.weight.consequence import Certainty, Consequence, weight_text
from roslens.model.words.plural import plural
from roslens.report.run.fix_first import counted, urgency
from roslens.report.writing.terminal import Terminal

MOST_NEW = 20
"""So many new findings are printed one by one, notes too."""
INDENT = " " * 7
LINES = 12
"""A message that is longer comes from a file that was made by a program."""
PLACES = 10
"""Further places of one finding."""


class Whole(msgspec.Struct, frozen=True):
    """Which findings are printed one by one.

    Attributes:
        grave: all with a grave consequence.
        new: the new ones, or those in changed files; None where there is nothing to compare with, or too many.
        alone: whether there are no others.
    """

    grave: Sequence[Finding] = ()
    new: Sequence[Finding] | None = None
    alone: bool = False


def fix_first_lines(
    terminal: Terminal,
    chosen: Sequence[RuleCount],
    new: int,
    rules: Mapping[str, RuleInfo],
    changes: Mapping[str, int],
) -> Iterator[str]:
    """Yield the findings to fix first, each with its consequence and rule; the first ``new`` are new."""
    if not chosen:
        return
    yield terminal.paint("Fix first", "title")
    for number, one in enumerate(chosen, 1):
        yield from _head(terminal, f"{number:>3}. ", one.severity, one.example)
        rule = f"new: {one.rule}" if number <= new else one.rule
        facts = [weight_of(one.weight, rules.get(one.rule)), " and ".join((rule, *one.also))]
        if one.alike:
            facts.append(f"the like in {plural(one.alike, 'other place')}")
        if commits := changes.get(one.path):
            facts.append(f"{plural(commits, 'commit')} to the file in a year")
        yield from _facts(terminal, facts)


def whole_lines(terminal: Terminal, findings: Iterable[Finding], rules: Mapping[str, RuleInfo]) -> Iterator[str]:
    """Yield findings one by one, whole, in the order in which to fix them; notes too."""
    for one in sorted(findings, key=lambda finding: (finding.severity is Severity.NOTE, urgency(counted(finding)))):
        yield from _head(terminal, "  ", one.severity, counted(one).example)
        yield from place_lines(terminal, one, INDENT)
        yield from _facts(
            terminal, [weight_of(one.weight, rules.get(one.rule)), " and ".join((one.rule, *one.witnesses))]
        )


def place_lines(terminal: Terminal, finding: Finding, indent: str) -> Iterator[str]:
    """Yield the further places of a finding, a line each."""
    others = (*finding.others, *finding.also) if not finding.model else ()
    for text in others[:PLACES]:
        for line in terminal.wrap(terminal.clean(text), indent, lines=LINES):
            yield terminal.paint(line, "quiet")
    if len(others) > PLACES:
        yield terminal.paint(f"{indent}and {plural(len(others) - PLACES, 'other place')}", "quiet")


def weight_of(weight: tuple[Consequence, Certainty], rule: RuleInfo | None) -> str:
    """Return consequence and certainty in words; a heuristic rule that nobody confirmed is unproven."""
    unproven = rule is not None and rule.unproven and weight[1] is Certainty.HEURISTIC
    return weight_text(*weight, unproven=unproven)


def _head(terminal: Terminal, start: str, severity: Severity, text: str) -> Iterator[str]:
    mark = terminal.paint(terminal.glyph(severity.value), severity.value)
    lines = terminal.wrap(terminal.clean(text), INDENT, lines=LINES) or [""]
    yield f"{start}{mark} {lines[0].lstrip()}"
    yield from lines[1:]


def _facts(terminal: Terminal, facts: Iterable[str]) -> Iterator[str]:
    text = terminal.clean(f" {terminal.glyph('dot')} ".join(facts))
    yield from (terminal.paint(line, "quiet") for line in terminal.wrap(text, INDENT))
