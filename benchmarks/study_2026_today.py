"""The second half of docs/study_2026.md: the same packages by the definitions and coding rules of roslens itself."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence

import msgspec
from study_2015 import coding_findings
from study_2026_tables import NEGLIGIBLE, change

from roslens.model.result import PackageSummary
from roslens.model.study import Column, Corpus, Subject
from roslens.report.study.study_tables import written
from roslens.source.study.describe import describe
from roslens.source.study.measurements import measurements

KEYS = (
    ("loc", "LOC", 1.0),
    ("comment_lines", "LOCom", 1.0),
    ("comment_ratio", "%Com", 0.01),
    ("cyclomatic_complexity", "CC", 1.0),
    ("cognitive_complexity", "cognitive complexity", 1.0),
    ("maintainability_index", "MI", 1.0),
    ("cbo", "CBO", 1.0),
    ("wmc", "WMC", 1.0),
    ("mac", "MAC", 1.0),
    ("rqv", "#RQV", 1.0),
)
"""Our own quantity, the row, and its factor to the paper's unit."""

MOST_RULES = 20


class Today(msgspec.Struct, frozen=True):
    """What the model `ros` and the coding rules that are on by default say of the packages of a corpus.

    ``lines`` are those of C, C++ and Python together; ``findings`` count by rule, of own code, and ``packages`` how
    many packages have one.
    """

    corpus: Corpus
    lines: float
    findings: Counter[str]
    packages: Counter[str]


def today_of(corpus: Corpus, summaries: Sequence[PackageSummary]) -> Today:
    """Return what is said of the packages of a corpus, by the runs that judged by `ros` alone."""
    wanted = {(one.repository, one.name) for one in corpus.packages}
    mine = [one for one in summaries if (one.repository, one.id) in wanted]
    columns = tuple(Column(key, title) for key, title, _ in KEYS)
    packages = tuple(
        Subject(
            one.id,
            one.repository,
            values={key: one.values[key] * factor for key, _, factor in KEYS if key in one.values},
        )
        for one in mine
    )
    findings: Counter[str] = Counter()
    having: Counter[str] = Counter()
    for one in mine:
        counts = coding_findings(one)
        findings.update(counts)
        having.update(counts.keys())
    lines = sum(one.values.get("loc", 0.0) for one in mine)
    return Today(Corpus("runs", corpus.sources, columns, packages), lines, findings, having)


def definitions(today: Mapping[str, Today], titles: Mapping[str, str]) -> list[str]:
    """Return medians and quartiles of each corpus."""
    figures = {}
    for name, one in today.items():
        with measurements(one.corpus) as connection:
            figures[name] = {row.key: row for row in describe(connection, one.corpus)}
    first, *others = today
    heads = [titles[name] for name in today] + [f"{titles[name]} against {titles[first]}" for name in others]
    lines = ["| row | " + " | ".join(heads) + " |", "| --- |" + " ---: |" * len(heads)]
    for key, title, _ in KEYS:
        write = written(Column(key, title))
        cells = []
        for name in today:
            found = figures[name].get(key)
            cells.append(f"**{write(found.median)}** ({write(found.lower)} to {write(found.upper)})" if found else "")
        deltas = [change(today[first].corpus, today[name].corpus, Column(key, title)) for name in others]
        cells += [f"{delta:+.2f}" + ("" if p < 0.05 else "*") for delta, p in deltas]
        lines.append(f"| {title} | " + " | ".join(cells) + " |")
    return lines


def lasting(today: Mapping[str, Today], titles: Mapping[str, str]) -> list[str]:
    """Return what differs more than negligibly, and not by chance, by these definitions."""
    first, *others = today
    lines = []
    for name in others:
        rows = []
        for key, title, _ in KEYS:
            delta, p = change(today[first].corpus, today[name].corpus, Column(key, title))
            if abs(delta) >= NEGLIGIBLE and p < 0.05:
                rows.append(f"{title} ({delta:+.2f})")
        lines.append(f"- {titles[name]}, more than a negligible difference: {', '.join(rows) or 'nothing'}.")
    return lines


def coding(today: Mapping[str, Today], titles: Mapping[str, str]) -> list[str]:
    """Return the coding rules that are broken most in any corpus, by findings for a thousand lines."""

    def density(name: str, rule: str) -> float:
        return 1000 * today[name].findings[rule] / today[name].lines if today[name].lines else 0.0

    known = {rule for one in today.values() for rule in one.findings}
    most = sorted(known, key=lambda rule: (-max(density(name, rule) for name in today), rule))[:MOST_RULES]
    lines = ["| rule | " + " | ".join(titles[name] for name in today) + " |", "| --- |" + " ---: |" * len(today)]
    for rule in most:
        cells = []
        for name, one in today.items():
            share = 100 * one.packages[rule] / max(1, len(one.corpus.packages))
            cells.append(f"{one.findings[rule]:,} ({density(name, rule):.2f}; {share:.0f} %)")
        lines.append(f"| `{rule}` | " + " | ".join(cells) + " |")
    totals = []
    for one in today.values():
        found = one.findings.total()
        totals.append(f"{found:,} ({1000 * found / one.lines if one.lines else 0:.2f})")
    return [*lines, "| all that are on by default | " + " | ".join(totals) + " |"]
