"""ROS code of today beside that of the 2016 study, by the study's own measures; writes docs/study_2026.md.

    python benchmarks/study_2026.py FOLDER           fetch and check FOLDER/2015, FOLDER/ros1 and FOLDER/ros2
    python benchmarks/study_2026.py FOLDER --kept    of the clones and runs that are there

The repositories are those of benchmarks/corpora: study_2015.repos, field_ros1.repos, and of field_ros2.repos those
whose commit is of 2022 or later. Needs the program cccc and `pip install 'roslens[study]'`.
"""

from __future__ import annotations

import argparse
import os
import subprocess
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml
from scipy import stats

from roslens.children.git import git_environment, git_words
from roslens.cli.main import main as roslens_main
from roslens.model.result import PackageSummary
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.study import PACKAGE, Broken, Column, Corpus, Figures, Subject
from roslens.report.study.study_tables import interval, written
from roslens.source.study.correlate import correlate
from roslens.source.study.csv_rows import read_csv
from roslens.source.study.describe import describe
from roslens.source.study.measurements import measurements
from roslens.source.study.paper_tables import COLUMNS, corpus_of
from roslens.source.study.role import decide, facts_of
from roslens.source.study.rule_totals import rule_totals
from roslens.store.runs import Store

ROOT = Path(__file__).parents[1]
LISTS = {
    name: ROOT / "benchmarks" / "corpora" / f"{file}.repos"
    for name, file in (("2015", "study_2015"), ("ros1", "field_ros1"), ("ros2", "field_ros2"))
}
RAW = ROOT / "tests" / "fixtures" / "study" / "package_repo_metrics.csv"
PAGE = ROOT / "docs" / "study_2026.md"
TITLES = {"2015": "2015", "ros1": "ROS 1", "ros2": "ROS 2"}
SINCE = "2022-01-01"
NEGLIGIBLE = 0.147
_LEFT_OUT = frozenset({"role", "open_issues", "closed_issues", "rcv"})
ROWS = tuple(column for column in COLUMNS if column.key not in _LEFT_OUT)
PAIRS = (("loc", "rqv"), ("loc", "comment_lines"), ("comment_lines", "rqv"), ("wmc", "mac"),
         ("comment_ratio", "maintainability_index"), ("cyclomatic_complexity", "maintainability_index"),
         ("comment_ratio", "cbo"), ("cyclomatic_complexity", "rqv"))  # fmt: skip


def fetch_and_check(folder: Path) -> None:
    """Fetch all three lists and check them as the study did."""
    for name, path in LISTS.items():
        roslens_main(["fetch", "--distribution", str(path), "--into", str(folder / name)])
        options = [
            "--model",
            "paper2016",
            "--tools",
            "none",
            "--fail-on",
            "never",
            "-q",
            "-o",
            str(folder / f"{name}.md"),
        ]
        roslens_main(["check", str(folder / name), *options])


def git(folder: Path, command: str, *words: str) -> str:
    """Return what git says of a clone."""
    asked = git_words(str(folder), command, *words)
    return subprocess.run(asked, env=git_environment(os.environ), capture_output=True, text=True, check=True).stdout


def repositories_of(folder: Path, names: Iterable[str], since: str) -> dict[str, Subject]:
    """Return each repository whose commit is not older than a day, with its commits and contributors."""
    found = {}
    for name in names:
        clone = next(one for list_ in LISTS if (one := folder / list_ / name).exists())
        if git(clone, "log", "-1", "--format=%cs").strip() < since:
            continue
        people = {line for line in git(clone, "log", "--format=%aN", "HEAD").splitlines() if line}
        commits = int(git(clone, "rev-list", "--count", "HEAD"))
        values = {"revisions": float(commits), "contributors": float(len(people))}
        found[name] = Subject(name, name, values=values)
    return found


def corpus_from(folder: Path, path: Path, since: str = "") -> Corpus:
    """Return the packages with C and C++ code of a list's repositories, as Table II has them.

    They are looked for in the last runs by `paper2016` of all three folders.
    """
    repositories = repositories_of(folder, yaml.safe_load(path.read_text())["repositories"], since)
    packages: list[Subject] = []
    broken: list[Broken] = []
    for one in LISTS:
        with Store.open(folder / one / ".roslens" / "store.sqlite") as store:
            view = store.view(next(run.id for run in store.runs() if run.header.models == ("paper2016",)))
            for summary in view.packages():
                values = _values(summary)
                if summary.id == OUTSIDE_PACKAGES or summary.repository not in repositories or "loc" not in values:
                    continue
                result = view.package(summary.id)
                role = decide(facts_of(result)).role if result else ""
                packages.append(Subject(summary.id, summary.repository, role, values=values))
                rules = [rule for rule in summary.rules if "metrics" in rule.tags]
                broken += [Broken(rule.rule, summary.id, role, rule.count) for rule in rules]
    used = {one.repository for one in packages}
    kept = tuple(one for name, one in repositories.items() if name in used)
    return Corpus("runs", (str(path),), ROWS, tuple(packages), kept, tuple(broken), "loc")


def _values(summary: PackageSummary) -> dict[str, float]:
    found = {key.partition(".")[2]: value for key, value in summary.values.items() if key.startswith("paper2016.")}
    if "comment_ratio" in found:
        found["comment_ratio"] /= 100
    if "dependents" in summary.values:
        found["dependents"] = summary.values["dependents"]
    return {column.key: found[column.key] for column in ROWS if column.of == PACKAGE and column.key in found}


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


def page(corpora: Mapping[str, Corpus]) -> str:
    """Return the page."""
    figures = {name: figures_of(corpus) for name, corpus in corpora.items()}
    sizes = [
        f"| {TITLES[name]} | {len(corpus.repositories)} | {len(corpus.packages)} | "
        f"{sum(one.values['loc'] for one in corpus.packages):,.0f} |"
        for name, corpus in corpora.items()
    ]
    parts: Sequence[str] = (
        _ABOUT,
        "\n".join(
            [
                "| corpus | repositories | packages with C or C++ | lines of code |",
                "| --- | ---: | ---: | ---: |",
                *sizes,
            ]
        ),
        _TABLE,
        "\n".join(table(corpora, figures)),
        _CHANGED,
        "\n".join(changed(corpora, figures)),
        _SHARES,
        "\n".join(shares(corpora, figures)),
        _RULES,
        "\n".join(rules(corpora)),
        _CORRELATIONS,
        "\n".join(correlations(corpora)),
        _ROLES,
        "\n".join(roles(corpora)),
    )
    return "\n".join(parts) + "\n"


_ABOUT = """\
# ROS code ten years on

How the code of ROS packages measures today, beside that of the 2016 study, by the same measures and from source. Three
corpora: the study's own packages at their commits of 2015; public repositories of ROS 1 at the end of their branches;
public repositories of ROS 2 whose last commit is of 2022 or later. `python benchmarks/study_2026.py FOLDER` fetches the
lists in `benchmarks/corpora`, each repository at the commit it names, measures, and writes this page.

Measures are those of the paper, with all their peculiarities (the quality model `paper2016`: cccc on each file alone,
means over values above 0, tests included), so that the columns can be compared; #Dep counts packages of the same
corpus. cccc knows C++ of 1998 and misses parts of newer code, which can make today's functions and classes look
smaller than they are. The corpora are what is public and well known: the study chose packages of eleven robots, the
other two are cores, navigation, manipulation, perception and drivers. They are no random samples.
"""
_TABLE = """
## Table II

Each cell: **median** (sample deviation; least to largest). #Rev and #DC over repositories, all else over packages. The
last columns are Cliff's delta against 2015: the share of pairs in which today's value is larger, less that in which it
is smaller, from -1 to 1; `*`: may be chance (Mann and Whitney, 0.05). #DC of 2015 is counted from git here, as for the
others; the paper's was typed in by hand.
"""
_CHANGED = """
## What changed

What is more than a negligible difference (a delta of 0.147 or more, Romano et al. 2006) and not chance:
"""
_SHARES = """
## Limits
"""
_RULES = """
## Rules that are broken

Each cell: findings (for each 1,000 lines; packages that have any). They are about classes and functions as roslens
knows them: a class whose methods stand in several files is one, where the study counts it in each (#RQV above does).
`class_limits` is a class that breaks several limits.
"""
_CORRELATIONS = """
## Correlations

With 95 % intervals; `*`: may be chance after correction for the number of pairs (Benjamini and Hochberg, 0.05).
"""
_ROLES = """
## Roles

As [`roslens roles`](reference/roles.md) tells them; of 2015 its own answers, not those given by hand.
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--kept", action="store_true", help="fetch and check nothing, take the last runs")
    options = parser.parse_args()
    if not options.kept:
        fetch_and_check(options.folder)
    studied = {one.name for one in corpus_of(read_csv(RAW)).packages}
    corpora = {name: corpus_from(options.folder, path, SINCE if name == "ros2" else "") for name, path in LISTS.items()}
    before = corpora["2015"]
    kept = tuple(one for one in before.packages if one.name in studied)
    names = {one.repository for one in kept}
    corpora["2015"] = Corpus(
        before.kind,
        before.sources,
        before.columns,
        kept,
        tuple(one for one in before.repositories if one.name in names),
        tuple(one for one in before.broken if one.package in studied),
        before.size_key,
    )
    PAGE.write_text(page(corpora))
    for name, corpus in corpora.items():
        print(f"{TITLES[name]}: {len(corpus.packages)} packages of {len(corpus.repositories)} repositories")


if __name__ == "__main__":
    main()
