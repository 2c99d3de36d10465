"""What sides of a comparison say differently, in words: for a terminal, and as Markdown."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence

from roslens.compare.conformance.disparity import Aspect, Conformance, Disparity, Reason
from roslens.model.finding import Severity
from roslens.report.writing.terminal import printable

MOST_ROWS = 300
FOLDED_FROM = 30
_NOT_KNOWN = "-"
_SIGNS = {Severity.ERROR: "✖", Severity.WARNING: "▲", Severity.NOTE: "·"}
REASONS = {
    Reason.CONDITION: "under a condition that was not met",
    Reason.NOT_RUNNING: "not running",
    Reason.INACTIVE: "of nodes that are not active",
    Reason.REMAPPED: "under another name",
    Reason.OTHER_LAUNCH: "started by another launch file",
    Reason.NOT_LAUNCHED: "built, but not started by the launch file",
    Reason.UNSTARTED: "made by code that no known program starts",
    Reason.PATTERN: "whose name is only partly known from source",
    Reason.INCOMPLETE: "where the source was read only in part",
    Reason.TOOL: "of tools",
    Reason.GUESSED: "that are uncertain in the source",
    Reason.NOT_RECORDED: "not recorded",
    Reason.IGNORED: "set and ignored",
    Reason.SET_OTHERWISE: "set otherwise",
    Reason.CONTRADICTION: "that contradict each other",
    Reason.UNKNOWN_TO_SOURCE: "not in the source",
    Reason.NOT_EXPECTED: "not expected",
    Reason.MISSING: "expected and missing",
}
"""What the differences of a kind have in common: ``3 not recorded``."""


def to_lines(found: Conformance, *, notes: bool = False) -> str:
    """Return a comparison as lines: each difference with what the sides say, who is right and why.

    Args:
        found: the comparison.
        notes: whether differences that are as they should be, or that nobody can decide, are shown one by one.
    """
    lines = [f"{mark}: {title} ({kind})" for mark, title, kind in _sides(found)]
    lines.append("")
    for one in found.disparities:
        if notes or one.severity is not Severity.NOTE:
            lines += _lines(one, found)
    hidden = [] if notes else [one for one in found.disparities if one.severity is Severity.NOTE]
    if hidden:
        lines.append(f"{_plural(len(hidden), 'note')} more: {_by_reason(hidden)}; --notes lists them")
    lines += found.notes
    lines.append(summary(found))
    return "".join(f"{printable(line)}\n" for line in lines)


def _sides(found: Conformance) -> Iterator[tuple[str, str, str]]:
    yield from zip("ABC", found.titles, found.kinds, strict=False)


def _lines(one: Disparity, found: Conformance) -> Iterator[str]:
    what = "" if one.aspect in (Aspect.PRESENCE, Aspect.EXPECTED) else f": {one.aspect.value}"
    also = f" (with {_plural(one.also, 'endpoint or parameter', 'endpoints and parameters')})" if one.also else ""
    yield f"{_SIGNS[one.severity]} {one.subject}{what}{also}"
    cells = [f"{mark} {cell}" for (mark, _, _), cell in zip(_sides(found), one.values, strict=True) if cell]
    yield f"    {'   '.join(cells)}"
    place = f" [{one.place}]" if one.place else ""
    yield f"    {one.why} Right: {one.right}.{place}"


def summary(found: Conformance) -> str:
    """Return how many things differ and how many agree, in a line."""
    counts = Counter(one.severity for one in found.disparities)
    counted = [_plural(counts[severity], severity.value) for severity in _SIGNS if counts[severity]]
    agreed = ", ".join(_plural(number, kind.replace("_", " ")) for kind, number in found.agreed.items())
    return f"{', '.join(counted) or 'no difference'}; alike: {agreed or 'nothing'}"


def _by_reason(found: Sequence[Disparity]) -> str:
    counts = Counter(one.reason for one in found)
    return ", ".join(f"{number} {REASONS[reason]}" for reason, number in counts.most_common())


def _plural(number: int, word: str, several: str = "") -> str:
    many = several or (f"{word[:-1]}ies" if word.endswith("y") else f"{word}s")
    return f"{number:,} {word if number == 1 else many}"


def to_markdown(found: Conformance) -> str:
    """Return a comparison as a table for a pull request or a report, folded where long."""
    head = " against ".join(_code(title) for title in found.titles)
    parts = [f"**Expected against actual**: {head}: {summary(found)}"]
    if found.disparities:
        titles = " | ".join(_cell(f"{kind}: {title}") for title, kind in zip(found.titles, found.kinds, strict=True))
        lines = [f"| | what | differs in | {titles} | right | why |", f"|{' --- |' * (len(found.titles) + 5)}"]
        lines += [_row(one) for one in found.disparities[:MOST_ROWS]]
        if (more := len(found.disparities) - MOST_ROWS) > 0:
            lines += ["", f"{more} more are not shown: `roslens compare` lists all."]
        if len(lines) > FOLDED_FROM:
            title = _plural(len(found.disparities), "difference")
            lines = [f"<details><summary>{title}</summary>", "", *lines, "", "</details>"]
        parts.append("\n".join(lines))
    parts += [_cell(text) for text in found.notes]
    return "\n\n".join(parts) + "\n"


def _row(one: Disparity) -> str:
    cells = " | ".join(_code(text) or _NOT_KNOWN for text in one.values)
    place = f" {_code(one.place)}" if one.place else ""
    why = f"{_cell(one.why)}{place}"
    return f"| {one.severity.value} | {_code(one.subject)} | {one.aspect.value} | {cells} | {one.right} | {why} |"


def _code(text: str) -> str:
    return f"`{_plain(text)}`" if text else ""


def _plain(text: str) -> str:
    return printable(" ".join(text.split())).replace("|", "\\|").replace("`", "'")


def _cell(text: str) -> str:
    """Return words that a forge shows as they are: no mark-up, no mention, no link."""
    return "".join(f"\\{sign}" if sign in "\\`*_[]<>#@~|" else sign for sign in printable(" ".join(text.split())))
