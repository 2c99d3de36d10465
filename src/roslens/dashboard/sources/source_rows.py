"""Lines of source as HTML. In Python, because a template takes as long for a piece as this for a line."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import msgspec
from markupsafe import Markup

from roslens.dashboard.computation.code_marks import CodeMark
from roslens.dashboard.sources.colours import Piece
from roslens.dashboard.sources.source_text import Excerpt
from roslens.dashboard.tables.table_rows import glyph_html
from roslens.model.finding import Finding


class CodeLine(msgspec.Struct, frozen=True):
    """A line of source with the findings that start on it, and what it is to the computation graphs."""

    number: int
    pieces: tuple[Piece, ...]
    findings: tuple[Finding, ...] = ()
    marks: tuple[CodeMark, ...] = ()


def source_html(
    lines: Iterable[CodeLine],
    notes: Callable[[Sequence[Finding]], str],
    marked: Callable[[Sequence[CodeMark]], str] = lambda _: "",
) -> Markup:
    """Return a row for each line.

    Args:
        lines: of source.
        notes: gives the HTML of the findings that start on one.
        marked: gives the HTML of what one is to the computation graphs.
    """
    rows = []
    for line in lines:
        flagged, glyph, margin = "", "", ""
        if line.findings:
            flagged, glyph = " flagged", glyph_html(line.findings[0].severity.value)
            margin = f'<div class="margin">{notes(line.findings)}</div>'
        number = line.number
        marks = f'<span class="marks">{marked(line.marks)}</span>' if line.marks else ""
        rows.append(
            f'<div class="row{flagged}" id="L{number}"><a class="n" href="#L{number}" aria-label="line {number}">'
            f'{number}</a><span class="g">{glyph}</span><code>{_pieces(line.pieces)}</code>{marks}{margin}</div>\n'
        )
    return Markup("".join(rows))  # noqa: S704 - every text was escaped below, notes are markup


def excerpt_html(excerpt: Excerpt) -> Markup:
    """Return the lines of an excerpt, those of the finding marked."""
    return Markup(  # noqa: S704 - every text was escaped below
        "".join(
            f'<span class="l{" hit" if hit else ""}"><i>{number}</i>{_pieces(pieces)}</span>'
            for number, hit, pieces in excerpt.lines
        )
    )


def _pieces(pieces: Iterable[Piece]) -> str:
    return "".join([f'<span class="{css}">{_escaped(text)}</span>' if css else _escaped(text) for css, text in pieces])


_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&#34;", "'": "&#39;"})


def _escaped(text: str) -> str:
    # Most pieces are words, and safe markup would be escaped again where it is joined to text.
    return text if text.isalnum() else text.translate(_ESCAPES)
