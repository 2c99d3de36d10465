"""A badge in SVG: how many errors and warnings there are, in words and in colour."""

from __future__ import annotations

from collections import Counter
from typing import TextIO

from roslens.model.finding import Severity
from roslens.model.words.plural import plural
from roslens.report.run.reported import Wanted, reported
from roslens.store.read import RunView

LABEL = "roslens"
_CHARACTER = 7
_PADDING = 10
_GREEN, _YELLOW, _RED, _GREY = "#2f7d32", "#8a6100", "#b3261e", "#5f6368"


def write_badge(view: RunView, stream: TextIO, wanted: Wanted) -> None:
    """Write the badge; what could not be analysed is never shown as clean.

    Raises:
        StoreError: the store cannot be read.
        OSError: the stream cannot be written.
    """
    counts = Counter(one.finding.severity for one in reported(view, wanted))
    lost = any(not failure.partial for failure in view.failures())
    lost = lost or (view.header.graphs is not None and view.header.graphs.is_mostly_unknown)
    text, colour = _said(counts, lost=lost, packages=len(view.packages()))
    stream.write(badge(text, colour))


def _said(counts: Counter[Severity], *, lost: bool, packages: int) -> tuple[str, str]:
    if not packages:
        return "no packages", _GREY
    parts = [plural(counts[one], one.value) for one in (Severity.ERROR, Severity.WARNING) if counts[one]]
    if lost:
        parts.append("incomplete")
    if counts[Severity.ERROR]:
        return ", ".join(parts), _RED
    if parts:
        return ", ".join(parts), _YELLOW
    return plural(counts[Severity.NOTE], "note") if counts[Severity.NOTE] else "no findings", _GREEN


def badge(text: str, colour: str) -> str:
    """Return the SVG; the text is of roslens alone and needs no escape."""
    left, right = (len(part) * _CHARACTER + _PADDING for part in (LABEL, text))
    return f"""\
<svg xmlns="http://www.w3.org/2000/svg" width="{left + right}" height="20" role="img" aria-label="{LABEL}: {text}">
<title>{LABEL}: {text}</title>
<clipPath id="r"><rect width="{left + right}" height="20" rx="3"/></clipPath>
<g clip-path="url(#r)"><rect width="{left}" height="20" fill="#3c4043"/>\
<rect x="{left}" width="{right}" height="20" fill="{colour}"/></g>
<g fill="#fff" font-family="Verdana,DejaVu Sans,sans-serif" font-size="11" text-anchor="middle">
<text x="{left / 2:g}" y="14" textLength="{left - _PADDING}">{LABEL}</text>
<text x="{left + right / 2:g}" y="14" textLength="{right - _PADDING}">{text}</text></g>
</svg>
"""
