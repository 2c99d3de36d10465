"""A study as text, CSV and LaTeX."""

from __future__ import annotations

import csv
import textwrap
from collections.abc import Iterable
from io import StringIO

from roslens.model.study import Study
from roslens.report.study.study_tables import HOLDS, StudyTable, lead, tables_of

_GAP = "  "
_WIDTH = 100
_LATEX = {
    "\\": r"\textbackslash{}", "&": r"\&", "%": r"\%", "$": r"\$", "#": r"\#", "_": r"\_", "{": r"\{", "}": r"\}",
    "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "<": r"\textless{}", ">": r"\textgreater{}",
}  # fmt: skip
_FORMULA = ("=", "+", "-", "@", "\t", "\r")


def study_text(study: Study) -> str:
    """Return tables for a terminal, and statements one below the other."""
    parts = [f"{lead(study)}\n"]
    for table in tables_of(study):
        parts.append(f"\n{table.title}\n{'=' * len(table.title)}\n")
        parts.append(_statements(study) if table.key == "statements" else _aligned(table))
        if table.key == "correlations":
            parts.append("with 95 % intervals; * : may be chance (Benjamini and Hochberg, 0.05)\n")
    return "".join(parts)


def _aligned(table: StudyTable) -> str:
    lines = (table.head, *table.rows)
    widths = [max(len(line[place]) for line in lines) for place in range(len(table.head))]
    return "".join(
        _GAP.join(
            cell.ljust(width) if place < table.texts else cell.rjust(width)
            for place, (cell, width) in enumerate(zip(line, widths, strict=True))
        ).rstrip()
        + "\n"
        for line in lines
    )


def _statements(study: Study) -> str:
    return "".join(
        f"{HOLDS[one.holds]:>13}  {_wrapped(one.says)}\n{'':15}{_wrapped(one.found)}\n" for one in study.statements
    )


def _wrapped(text: str) -> str:
    return textwrap.fill(text, _WIDTH, subsequent_indent=" " * 15, break_long_words=False, break_on_hyphens=False)


def study_csv(study: Study) -> str:
    """Return all tables in one file, each row led by the key of its table; RFC 4180.

    Cells that a spreadsheet would run get an apostrophe in front, as in other tables of roslens.
    """
    out = StringIO(newline="")
    writer = csv.writer(out, lineterminator="\r\n")
    for table in tables_of(study, complete=True, grouped=False):
        writer.writerow(("table", *table.head))
        writer.writerows((table.key, *map(_cell, row)) for row in table.rows)
    return out.getvalue()


def _cell(text: str) -> str:
    is_number = text.lstrip("-").replace(".", "", 1).isdigit()
    return f"'{text}" if text.startswith(_FORMULA) and not is_number and text != "-" else text


def study_latex(study: Study) -> str:
    """Return a table environment for each table; they want the package booktabs."""
    return "\n".join(_tabular(table) for table in tables_of(study))


def _tabular(table: StudyTable) -> str:
    if table.key == "statements":
        columns = "p{0.35\\linewidth}p{0.45\\linewidth}l"
    else:
        columns = "l" * table.texts + "r" * (len(table.head) - table.texts)
    lines = [
        r"\begin{table}",
        rf"\caption{{{_escaped(table.title)}}}\label{{tab:{table.key}}}",
        rf"\begin{{tabular}}{{{columns}}}",
        r"\toprule",
        _line(table.head),
        r"\midrule",
        *(_line(row) for row in table.rows),
        r"\bottomrule",
        r"\end{tabular}",
        r"\end{table}",
    ]
    return "\n".join(lines) + "\n"


def _line(cells: Iterable[str]) -> str:
    return " & ".join(map(_escaped, cells)) + r" \\"


def _escaped(text: str) -> str:
    return "".join(_LATEX.get(letter, letter) for letter in text)
