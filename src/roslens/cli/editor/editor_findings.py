"""Findings as an editor shows them: ranges in its own columns, text to hover over, an action that silences one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec

from roslens.model.failure import Failure
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.words.silence_comment import measured_text, silence_comment
from roslens.report.run.finding_text import weight_of
from roslens.report.run.fix_first import by_urgency, counted, urgency

SEVERITIES = {Severity.ERROR: 1, Severity.WARNING: 2, Severity.NOTE: 3}
"""Numbers of the Language Server Protocol; a finding that does not count is a hint, 4."""
HINT = 4

_HASH_COMMENTS = (".py", ".cmake", "CMakeLists.txt", ".yaml", ".yml", ".msg", ".srv", ".action")
_SLASH_COMMENTS = (".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".hxx", ".ipp", ".tpp")


class Span(msgspec.Struct, frozen=True):
    """A range of one line: 0-based line, and columns in units of UTF-16, the last one behind it."""

    line: int
    start: int
    end: int


class Shown(msgspec.Struct, frozen=True):
    """A finding with its range and severity, as the protocol counts them."""

    finding: Finding
    span: Span
    severity: int


class Edit(msgspec.Struct, frozen=True):
    """Text that an action inserts at a 0-based line and a column in units of UTF-16."""

    title: str
    line: int
    column: int
    text: str


def shown(findings: Iterable[Finding], lines: Sequence[str]) -> tuple[Shown, ...]:
    """Return findings of a file with these lines, those to fix first before others; a long one on its first line."""
    order = by_urgency(findings)
    return tuple(Shown(one, span_of(one, lines), SEVERITIES[one.severity] if one.gated else HINT) for one in order)


def span_of(finding: Finding, lines: Sequence[str]) -> Span:
    """Return the range of a finding; that of a whole file is its first line."""
    number = min(max(finding.line, 1), max(len(lines), 1)) - 1
    text = lines[number].rstrip("\r\n") if number < len(lines) else ""
    indent = len(text) - len(text.lstrip())
    start = utf16_column(text, finding.column) if finding.line and finding.column else indent
    end = utf16_length(text)
    if finding.line and finding.end_line == finding.line and finding.end_column >= finding.column > 0:
        end = utf16_column(text, finding.end_column + 1)
    return Span(number, min(start, end), max(end, start))


def utf16_column(text: str, column: int) -> int:
    """Return a 1-based column in bytes of UTF-8 as a 0-based one in units of UTF-16."""
    return utf16_length(text.encode("utf-8", "surrogateescape")[: max(0, column - 1)].decode("utf-8", "replace"))


def utf16_length(text: str) -> int:
    """Return how many units of UTF-16 a text has."""
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


def hover_text(findings: Sequence[Finding], rules: dict[str, RuleInfo]) -> str:
    """Return what the rules of findings mean, as Markdown."""
    parts = []
    for rule in dict.fromkeys(one.rule for one in sorted(findings, key=lambda one: urgency(counted(one)))):
        info = rules.get(rule)
        order = sorted((one for one in findings if one.rule == rule), key=lambda one: -one.weight[1].rank)
        said = [f"- {one.message} ({weight_of(one.weight, info)})" for one in order]
        parts.append("\n".join([f"**{info.title if info else rule}** (`{rule}`)", "", *said]))
        if info:
            parts.extend(text for text in (info.description, info.rationale, *_advice(info), info.url) if text)
    return "\n\n".join(parts)


def _advice(rule: RuleInfo) -> Iterator[str]:
    """Yield what to write instead, whether that can be done safely, how often the rule is right, how to silence it."""
    if rule.good:
        fence = rule.languages[0] if rule.languages else ""
        yield f"Instead:\n\n```{fence}\n{rule.good}\n```"
    if rule.fix:
        yield f"Safe fix: {rule.fix}"
    if measured := measured_text(rule):
        yield f"{measured[0].upper()}{measured[1:]}."
    yield f"To leave it out here: `{silence_comment(rule)}`"


def ignore_edits(finding: Finding, path: str, lines: Sequence[str]) -> tuple[Edit, ...]:
    """Return the insertions that silence a finding where it stands; none where its file has no comments for that."""
    if path.endswith(_HASH_COMMENTS):
        mark = "#"
    elif path.endswith(_SLASH_COMMENTS):
        mark = "//"
    else:
        return ()
    form = "ignore" if finding.line else "ignore-file"
    number = min(max(finding.line, 1), max(len(lines), 1)) - 1
    text = lines[number].rstrip("\r\n") if number < len(lines) else ""
    if text.rstrip().endswith("\\"):
        return ()
    title = f"Ignore {finding.rule} here, with a reason" if finding.line else f"Ignore {finding.rule} in this file"
    return (Edit(title, number, utf16_length(text), f"  {mark} roslens: {form}[{finding.rule}] "),)


def failure_as_finding(failure: Failure) -> Finding:
    """Return a finding about the parts of a file that were not analysed."""
    place = failure.location
    return Finding(
        "roslens.not_analysed",
        Severity.WARNING if failure.partial else Severity.ERROR,
        f"not analysed: {failure.what}" + (f". {failure.advice}" if failure.advice else ""),
        place.path if place else "",
        place.line if place else 0,
        place.column if place else 0,
    )
