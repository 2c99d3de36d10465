"""Writes docs/reports.md from the cases and the tables that are kept."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path

from reports.recorded import Table, tables
from reports.report_case import ROOT, ROUNDS, Rebuilt, rebuilt
from reports.scoring import VERDICTS

PAGE = ROOT / "docs" / "reports.md"
HEAD = Path(__file__).parent / "head.md"
_COLUMNS = "told | note | failure | silent | told, of all"


def page() -> str:
    """Return the page.

    Raises:
        ValueError: a case or a table is not what it has to be.
    """
    rounds = {name: (rebuilt(name), tables(name)) for name in ROUNDS}
    lines = [HEAD.read_text("utf-8").rstrip("\n"), "", "## Totals", ""]
    lines += [f"| round | revision | mistakes | {_COLUMNS} | correct forms | with a false alarm |"]
    lines += ["| --- | --- | --: | --: | --: | --: | --: | --: | --: | --: |"]
    for name, (_, kept) in rounds.items():
        lines += [_total(name, table) for table in kept]
    for name, (cases, kept) in rounds.items():
        lines += ["", f"## Round {name}", ""]
        if name != ROUNDS[0] and len(kept) < 2:
            lines.append(
                f"{len(cases)} reports. They are listed when the round is scored a second time, so that until then "
                "nothing is changed because of one of them."
            )
        else:
            lines += [*_by("area", cases, kept), "", *_by("consequence", cases, kept), "", *_mistakes(cases, kept)]
            lines += ["", *_correct(cases, kept[-1])]
    return "\n".join(lines) + "\n"


def _total(name: str, table: Table) -> str:
    verdicts = Counter(one.verdict for one in table.scores if one.verdict)
    count = verdicts.total()
    alarmed = sum(bool(one.alarms) for one in table.scores)
    cells = [name, f"`{table.revision}` {table.date}", count, *(verdicts[one] for one in VERDICTS)]
    return _row([*cells, f"{100 * verdicts['told'] / count:.0f} %", len(table.scores), alarmed])


def _by(what: str, cases: Sequence[Rebuilt], kept: Sequence[Table]) -> list[str]:
    """Return a table of how many mistakes are told, by area or consequence, at the first and the last revision."""
    shown = kept if len(kept) == 1 else (kept[0], kept[-1])
    groups: dict[str, list[str]] = {}
    for one in cases:
        if one.case.bad:
            groups.setdefault(getattr(one.case, what), []).append(one.name)
    lines = [f"| {what} | mistakes | {' | '.join(f'told at `{table.revision}`' for table in shown)} |"]
    lines.append("| --- | --: " + "| --: " * len(shown) + "|")
    by_name = [table.by_name() for table in shown]
    for group, names in groups.items():
        told = [sum(table[name].verdict == "told" for name in names) for table in by_name]
        lines.append(_row([group, len(names), *told]))
    return lines


def _mistakes(cases: Sequence[Rebuilt], kept: Sequence[Table]) -> list[str]:
    revisions = " | ".join(f"`{table.revision}`" for table in kept)
    lines = [f"| case | mistake | report | consequence | {revisions} | by |"]
    lines.append("| --- " * (5 + len(kept)) + "|")
    by_name = [table.by_name() for table in kept]
    for one in cases:
        if one.case.bad:
            scores = [table[one.name] for table in by_name]
            rule = scores[-1].by.split(" ")[1] if scores[-1].verdict in ("told", "note") else ""
            verdicts = [score.verdict for score in scores]
            cells = [
                one.name.partition("-")[0],
                f"{one.case.title}. Why: {one.case.wrong}",
                _link(one),
                one.case.consequence,
            ]
            lines.append(_row([*cells, *verdicts, f"`{rule}`" if rule else ""]))
    return lines


def _correct(cases: Sequence[Rebuilt], last: Table) -> list[str]:
    scores = last.by_name()
    lines = [
        "Correct code that looks like a mistake, of reports in which it was taken for one:",
        "",
        "| case | what | report | why it is correct | warnings and errors |",
        "| --- | --- | --- | --- | --: |",
    ]
    for one in cases:
        if not one.case.bad:
            cells = [one.name.partition("-")[0], one.case.title.removeprefix("Clean: "), _link(one)]
            lines.append(_row([*cells, one.case.why_correct, len(scores[one.name].alarms)]))
    alarms = [
        f"- {'the corrected form of ' if one.case.bad else ''}{one.name.partition('-')[0]}: {alarm}"
        for one in cases
        for alarm in scores[one.name].alarms
    ]
    return [
        *lines,
        "",
        "False alarms:" if alarms else "No correct form has a false alarm.",
        *(["", *alarms] if alarms else []),
    ]


def _link(one: Rebuilt) -> str:
    repository, _, number = one.case.source.partition("#")
    return f"[{one.case.source}](https://github.com/{repository}/issues/{number})"


def _row(cells: Iterable[object]) -> str:
    return "| " + " | ".join(str(cell).replace("|", "\\|").replace("<", "&lt;") for cell in cells) + " |"
