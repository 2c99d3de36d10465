"""The tables of docs/study_2026.md by the study's own measures: what its corpora are and how they differ."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

from scipy import stats

from roslens.model.study import Column, Corpus, Figures
from roslens.report.study.study_tables import interval, written
from roslens.source.study.correlate import correlate
from roslens.source.study.describe import describe
from roslens.source.study.measurements import measurements
from roslens.source.study.paper_tables import COLUMNS
from roslens.source.study.rule_totals import rule_totals

TITLES = {"2015": "2015", "ros1": "ROS 1", "ros2": "ROS 2"}
NEGLIGIBLE = 0.147
_LEFT_OUT = frozenset({"role", "open_issues", "closed_issues", "rcv"})
ROWS = tuple(column for column in COLUMNS if column.key not in _LEFT_OUT)
PAIRS = (("loc", "rqv"), ("loc", "comment_lines"), ("comment_lines", "rqv"), ("wmc", "mac"),
         ("comment_ratio", "maintainability_index"), ("cyclomatic_complexity", "maintainability_index"),
         ("comment_ratio", "cbo"), ("cyclomatic_complexity", "rqv"))  # fmt: skip


def figures_of(corpus: Corpus) -> dict[str, Figures]:
    """Return the key figures by quantity."""
    with measurements(corpus) as connection:
        return {one.key: one for one in describe(connection, corpus)}


def change(before: Corpus, after: Corpus, column: Column) -> tuple[float, float]:
    """Return Cliff's delta of a quantity and how probable it is by chance (Mann and Whitney)."""
    old, new = ([one.values[column.key] for one in corpus.subjects(column)] for corpus in (before, after))
    found: Any = stats.mannwhitneyu(new, old, alternative="two-sided")
    delta = 2 * float(found.statistic) / (len(old) * len(new)) - 1
    return delta, float(found.pvalue)


def changed(corpora: Mapping[str, Corpus], figures: Mapping[str, Mapping[str, Figures]]) -> list[str]:
    """Return a sentence for each quantity that differs more than negligibly, and not by chance."""
    lines = []
    for name in ("ros1", "ros2"):
        for column in ROWS:
            delta, p = change(corpora["2015"], corpora[name], column)
            if abs(delta) >= NEGLIGIBLE and p < 0.05:
                write = written(column)
                old, new = (write(figures[one][column.key].median) for one in ("2015", name))
                word = "larger" if delta > 0 else "smaller"
                lines.append(
                    f"- {TITLES[name]}: {column.title} is {word}, {new} against {old} in the median ({delta:+.2f})."
                )
    return lines


def table(corpora: Mapping[str, Corpus], figures: Mapping[str, Mapping[str, Figures]]) -> list[str]:
    """Return Table II of all three, each cell median (sample deviation; least to largest)."""
    lines = ["| row | " + " | ".join(TITLES.values()) + " | ROS 1 against 2015 | ROS 2 against 2015 |"]
    lines += ["| --- |" + " ---: |" * 5]
    for column in ROWS:
        cells = []
        for name in TITLES:
            one, write = figures[name][column.key], written(column)
            deviation = "" if one.deviation is None else write(one.deviation)
            cells.append(f"**{write(one.median)}** ({deviation}; {write(one.least)} to {write(one.most)})")
        deltas = [change(corpora["2015"], corpora[name], column) for name in ("ros1", "ros2")]
        changes = [f"{delta:+.2f}" + ("" if p < 0.05 else "*") for delta, p in deltas]
        lines.append(f"| {column.title} | " + " | ".join([*cells, *changes]) + " |")
    return lines


def shares(corpora: Mapping[str, Corpus], figures: Mapping[str, Mapping[str, Figures]]) -> list[str]:
    """Return what part of packages breaks limits."""
    lines = ["| of packages | " + " | ".join(TITLES.values()) + " |", "| --- |" + " ---: |" * 3]
    for column in ROWS:
        if column.threshold and column.key != "maintainability_index":
            beyond = (figures[name][column.key].share_beyond or 0 for name in TITLES)
            text = " | ".join(f"{100 * share:.0f} %" for share in beyond)
            lines.append(f"| {column.title} itself outside {column.threshold} | {text} |")
    clean = [_share(corpora[name], lambda values: values["rqv"] == 0) for name in TITLES]
    lines.append("| without any finding of the model | " + " | ".join(clean) + " |")
    density = [_density(corpora[name]) for name in TITLES]
    lines.append("| findings of the model for each 1,000 lines, all packages together | " + " | ".join(density) + " |")
    return lines


def _share(corpus: Corpus, holds: Any) -> str:
    return f"{100 * sum(holds(one.values) for one in corpus.packages) / len(corpus.packages):.0f} %"


def _density(corpus: Corpus) -> str:
    findings, lines = (sum(one.values[key] for one in corpus.packages) for key in ("rqv", "loc"))
    return f"{1000 * findings / lines:.2f}"


def rules(corpora: Mapping[str, Corpus]) -> list[str]:
    """Return how often each rule is broken for each 1,000 lines of code."""
    totals = {name: {one.rule: one for one in rule_totals(corpus.broken)} for name, corpus in corpora.items()}
    sizes = {name: sum(one.values["loc"] for one in corpus.packages) for name, corpus in corpora.items()}
    known = sorted(
        {rule for one in totals.values() for rule in one},
        key=lambda rule: -totals["2015"][rule].count if rule in totals["2015"] else 0,
    )
    lines = ["| rule | " + " | ".join(TITLES.values()) + " |", "| --- |" + " ---: |" * 3]
    for rule in known:
        cells = []
        for name, corpus in corpora.items():
            one = totals[name].get(rule)
            if one is None:
                cells.append("0")
            else:
                share = 100 * one.packages / len(corpus.packages)
                cells.append(f"{one.count:,} ({1000 * one.count / sizes[name]:.2f}; {share:.0f} %)")
        lines.append(f"| {rule} | " + " | ".join(cells) + " |")
    return lines


def correlations(corpora: Mapping[str, Corpus]) -> list[str]:
    """Return Pearson's and Spearman's coefficients of the pairs that the paper speaks of."""
    found = {name: {(one.one, one.other): one for one in correlate(corpus)} for name, corpus in corpora.items()}
    titles = {column.key: column.title for column in ROWS}
    lines = ["| pair | " + " | ".join(f"{title}: Pearson | Spearman" for title in TITLES.values()) + " |"]
    lines += ["| --- |" + " ---: |" * 6]
    for pair in PAIRS:
        cells = []
        for name in TITLES:
            one = found[name].get(pair)
            cells += [interval(one.pearson), interval(one.spearman)] if one else ["", ""]
        lines.append(f"| {titles[pair[0]]} ~ {titles[pair[1]]} | " + " | ".join(cells) + " |")
    return lines


def roles(corpora: Mapping[str, Corpus]) -> list[str]:
    """Return how packages divide among roles."""
    lines = ["| role | " + " | ".join(TITLES.values()) + " |", "| --- |" + " ---: |" * 3]
    counts = {name: Counter(one.role for one in corpus.packages) for name, corpus in corpora.items()}
    for role in ("driver", "library", "application"):
        cells = (
            f"{counts[name][role]} ({100 * counts[name][role] / len(corpora[name].packages):.0f} %)" for name in TITLES
        )
        lines.append(f"| {role} | " + " | ".join(cells) + " |")
    return lines
