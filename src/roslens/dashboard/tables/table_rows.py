"""The rows of a table as HTML. In Python, because a thousand rows of twenty cells are too many for a template."""

from __future__ import annotations

from collections.abc import Callable

from markupsafe import Markup, escape

from roslens.dashboard.address import PageRef
from roslens.dashboard.tables.breakable import with_breaks
from roslens.dashboard.tables.table import Cell, Column, Table, shown

Link = Callable[[PageRef], str]


def rows_html(table: Table, link: Link) -> Markup:
    """Return the ``tr`` elements of a table; every text of a cell is escaped."""
    digits = table.digits()
    most = [table.most(place) if column.bar else 0.0 for place, column in enumerate(table.columns)]
    ends = _all_ends(table)
    parts: list[str] = []
    for number, row in enumerate(table.rows):
        parts.append(f'<tr data-id="{escape(table.identities[number])}">' if table.identities else "<tr>")
        for place, cell in enumerate(row):
            column = table.columns[place]
            sortable = (
                f' data-v="{cell.value}"' if column.kind == "number" and cell.text and cell.value is not None else ""
            )
            bar = _bar(cell.value, most[place]) if column.bar else ""
            inner = _inner(column, cell, digits[place], link)
            opening, closing = ends[place]
            parts.append(f"{opening}{sortable}>{bar}{inner}{closing}")
        parts.append("</tr>\n")
    return Markup("".join(parts))  # noqa: S704 - every text was escaped above


def _all_ends(table: Table) -> list[tuple[str, str]]:
    """Return what the cells of each column begin and end with."""
    named = 2 if table.columns and table.columns[0].kind == "mark" else 1
    found = []
    for place, column in enumerate(table.columns):
        labelled = table.stacked and (place >= named or column.kind == "number")
        found.append(_ends(place, column, _label(column) if labelled else ""))
    return found


def _ends(place: int, column: Column, label: str) -> tuple[str, str]:
    """Return what a cell of a column begins and ends with; the first names what its row is about."""
    if place == 0 and column.kind != "mark":
        return f'<th scope="row"{_classes(column)}{label}', "</th>"
    return f"<td{_classes(column)}{label}", "</td>"


def _label(column: Column) -> str:
    """Return the head of a column as an attribute of its cells, for where they have no head above them."""
    title = f"{column.title} ({column.unit})" if column.unit else column.title
    return "" if column.kind in {"mark", "prose"} else f' data-label="{escape(title)}"'


def _classes(column: Column) -> str:
    names = [
        *(("num",) if column.kind == "number" else ()),
        *((column.kind,) if column.kind in {"day", "prose"} else ()),
        *(("optional",) if column.optional else ()),
        *(("barred",) if column.bar else ()),
    ]
    return f' class="{" ".join(names)}"' if names else ""


def _bar(value: object, most: float) -> str:
    if not isinstance(value, int | float) or value <= 0 or most <= 0:
        return ""
    return (
        f'<svg class="bar" aria-hidden="true"><rect width="{max(1.5, 100 * value / most):.1f}%" height="100%"/></svg>'
    )


def _inner(column: Column, cell: Cell, digits: int, link: Link) -> str:
    if cell.refs:
        return " ".join(_linked(escape(name), ref, "", link) for name, ref in cell.refs)
    if cell.spark:
        return _spark(cell.spark)
    if column.kind == "mark":
        return mark_html(str(cell.value), cell.text or "")
    # A plain string: what is joined to safe markup would be escaped once more.
    text = str(
        ticks(shown(column, cell, digits)) if column.kind in {"text", "prose"} else escape(shown(column, cell, digits))
    )
    if column.kind in {"code", "name"}:
        text = with_breaks(text)
    if column.kind == "code" and text:
        text = f"<code>{text}</code>"
    return _rating(cell.rating) + _linked(text, cell.ref, cell.hint, link)


def _linked(text: str, ref: PageRef | None, hint: str, link: Link) -> str:
    title = f' title="{escape(hint)}"' if hint else ""
    href = link(ref) if ref else ""
    if href:
        return f'<a href="{escape(href)}"{title}>{text}</a>'
    return f"<span{title}>{text}</span>" if title else text


def _spark(counts: tuple[int, ...]) -> str:
    most = max(counts)
    bars = "".join(
        f'<rect x="{3 * place}" y="{18 - height:.1f}" width="2.4" height="{height:.1f}"/>'
        for place, count in enumerate(counts)
        if count
        for height in (max(1.0, 16 * count / most),)
    )
    box = f'viewBox="0 0 {3 * len(counts)} 18" preserveAspectRatio="none"'
    return f'<svg class="spark" {box} aria-hidden="true">{bars}</svg>'


def ticks(text: str) -> Markup:
    """Return the text with what stands between backticks as code; everything is escaped.

    A factor, as in ``(limit 5, 8.6 x)``, stays on one line.
    """
    text = text.replace(" x)", "\N{NO-BREAK SPACE}x)")
    parts = escape(text).split("`")
    if len(parts) % 2 == 0 or len(parts) == 1:
        return escape(text)
    return Markup("").join(
        Markup("<code>{}</code>").format(part) if place % 2 else part for place, part in enumerate(parts)
    )


def glyph_html(name: str) -> str:
    """Return the sign of a severity or a rating; ``name`` is one of ours, never text from source."""
    return f'<svg class="glyph {name}" viewBox="0 0 16 16" aria-hidden="true"><use href="#g-{name}"/></svg>'


def mark_html(name: str, words: str = "") -> str:
    """Return sign and words; its name where there are none."""
    safe = str(escape(name))
    return f'<span class="mark">{glyph_html(safe)}{escape(words or name)}</span>'


def _rating(name: str) -> str:
    if not name:
        return ""
    return f'<span class="rating" title="{name}">{glyph_html(name)}<span class="sr">{name}</span></span>'
