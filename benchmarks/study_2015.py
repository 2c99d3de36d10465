"""The 2016 study from source: its 48 repositories, measured again and held against its raw data; writes docs/study.md.

    python benchmarks/study_2015.py FOLDER                    fetch the list into FOLDER, check it twice, compare
    python benchmarks/study_2015.py FOLDER --config FILE      the same from mirrors, named under [fetch.rewrite] in FILE
    python benchmarks/study_2015.py FOLDER --kept             of the clones and runs that are there

The list is benchmarks/corpora/study_2015.repos: for each repository the commit of the branch in the distribution file
of October 2015 that has as many ancestors as the raw data says commits. Needs the program cccc (Debian's package) and
`pip install 'roslens[study]'`.
"""

from __future__ import annotations

import argparse
import csv
import os
import subprocess
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

import yaml

from roslens.children.git import git_environment, git_words
from roslens.cli.main import main as roslens_main
from roslens.model.result import PackageSummary
from roslens.model.study import Column, Corpus, Figures, Subject
from roslens.report.study.study_tables import written
from roslens.source.study.describe import describe
from roslens.source.study.measurements import measurements
from roslens.source.study.paper_tables import COLUMNS, ROLES
from roslens.store.runs import Store

ROOT = Path(__file__).parents[1]
LIST = ROOT / "benchmarks" / "corpora" / "study_2015.repos"
RAW = ROOT / "tests" / "fixtures" / "study" / "package_repo_metrics.csv"
PAGE = ROOT / "docs" / "study.md"

COMPARED = {
    "Cpp LoC": ("LOC", "loc", 0.0),
    "Cpp LoCom": ("LOCom", "comment_lines", 0.0),
    "CC": ("CC", "cyclomatic_complexity", 0.00501),
    "CBO": ("CBO", "cbo", 1e-9),
    "WMC": ("WMC", "wmc", 1e-9),
    "MAC": ("MAC", "mac", 1e-9),
    "NoC": ("NOC", "noc", 1e-9),
    "DIT": ("DIT", "dit", 1e-9),
    "Maintainability": ("MI", "maintainability_index", 1e-6),
    "Metrics Violations": ("#RQV", "rqv", 0.0),
}
"""Column of the raw data: the paper's name, our quantity below `paper2016.`, and how near is equal.

CC has two decimals in the raw data, means have twelve digits, the index ten.
"""

CORRECTED = (
    ("loc", "loc", 1.0, "C, C++ and Python; a line with code and a comment is code"),
    ("comment_lines", "comment_lines", 1.0, "C, C++ and Python; lines with a comment and no code, docstrings too"),
    ("comment_ratio", "comment_ratio", 0.01, "the same ratio, of these two"),
    ("cyclomatic_complexity", "cyclomatic_complexity", 1.0, "every function once, Python too"),
    (
        "maintainability_index",
        "maintainability_index",
        1.0,
        "without the bonus for comments, which lifts it above the scale",
    ),
    ("cbo", "cbo", 1.0, "classes of all files of a package see each other; classes with 0 count"),
    ("wmc", "wmc", 1.0, "the sum of the complexities of methods, not their number; classes with 0 count"),
    ("mac", "mac", 1.0, "the same, across files; classes with 0 count"),
    ("dependents", "dependents", 1.0, "among all packages of the 48 repositories"),
    ("rqv", "rqv", 1.0, "all rules of the model `ros`, not six of 13; own code only, tests left out"),
)
"""Row of Table II, our own quantity, its factor to the paper's unit, and what is different."""


def fetch_and_check(folder: Path, configuration: Path | None) -> None:
    """Fetch the list and check it, as the study did and as roslens does; say what each step took.

    Args:
        folder: that repositories and runs come to.
        configuration: of the fetch; None for the nearest.

    Raises:
        SystemExit: a repository is missing.
    """
    begun = time.monotonic()
    named = ["--config", str(configuration)] if configuration else []
    if roslens_main(["fetch", "--distribution", str(LIST), "--into", str(folder), *named]):
        raise SystemExit("not all repositories are there: the study would be of others; run the same command again")
    print(f"fetched in {time.monotonic() - begun:.0f} s", flush=True)
    for model in ("paper2016", "ros"):
        begun = time.monotonic()
        options = ["--model", model, "--tools", "none", "--fail-on", "never", "-q", "-o", str(folder / f"{model}.md")]
        roslens_main(["check", str(folder), *options])
        print(f"checked by {model} in {time.monotonic() - begun:.0f} s", flush=True)


def values_of(folder: Path, model: str) -> dict[str, Mapping[str, float]]:
    """Return the values of packages by name, of the last run that judged by one quality model alone."""
    with Store.open(folder / ".roslens" / "store.sqlite") as store:
        for run in store.runs():
            view = store.view(run.id)
            if view.header.models == (model,):
                return {one.name: one.values for one in view.packages()}
    return {}


def commits_of(folder: Path) -> int:
    """Return `git rev-list HEAD --count` of a clone."""
    words = git_words(str(folder), "rev-list", "--count", "HEAD")
    done = subprocess.run(words, env=git_environment(os.environ), capture_output=True, text=True, check=True)
    return int(done.stdout)


def differences(
    rows: Sequence[Mapping[str, str]], found: Mapping[str, Mapping[str, float]]
) -> tuple[dict[str, int], list[tuple[str, str, str, str]]]:
    """Return how many packages are equal in each column, and each difference: package, column, paper's, ours."""
    equal = dict.fromkeys((name for name, _, _ in COMPARED.values()), 0)
    differing: list[tuple[str, str, str, str]] = []
    for row in rows:
        values = found.get(row["Package"], {})
        for column, (name, key, near) in COMPARED.items():
            ours = values.get(f"paper2016.{key}")
            if ours is not None and abs(ours - float(row[column])) <= near:
                equal[name] += 1
            else:
                differing.append((row["Package"], name, row[column], "not measured" if ours is None else f"{ours:.6g}"))
    return equal, differing


def figures(
    rows: Sequence[Mapping[str, str]], found: Mapping[str, Mapping[str, float]], keys: Sequence[str]
) -> dict[str, Figures]:
    """Return the key figures of quantities over the packages of the study."""
    packages = tuple(
        Subject(row["Package"], row["Repository"], ROLES[int(row["Level"])], values=dict(found.get(row["Package"], {})))
        for row in rows
    )
    corpus = Corpus("runs", (), tuple(Column(key, key) for key in keys), packages)
    with measurements(corpus) as connection:
        return {one.key: one for one in describe(connection, corpus)}


def page(
    rows: Sequence[Mapping[str, str]],
    equal: Mapping[str, int],
    differing: Sequence[tuple[str, str, str, str]],
    revisions: Sequence[tuple[str, int, int]],
    faithful: Mapping[str, Figures],
    corrected: Mapping[str, Figures],
    broken: Mapping[str, Mapping[str, int]],
) -> str:
    """Return the page."""
    n = len(rows)
    same = sum(paper == ours for _, paper, ours in revisions)
    lines = [
        _ABOUT,
        "| quantity | packages equal |",
        "| --- | ---: |",
        *(f"| {name} | {count} of {n} |" for name, count in equal.items()),
        f"| #Rev | {same} of {len(revisions)} repositories |",
        "",
        _NOT_AGAIN,
        "## What differs",
        "",
    ]
    if differing or same < len(revisions):
        lines += ["| what | quantity | the study | here |", "| --- | --- | ---: | ---: |"]
        lines += [f"| {package} | {name} | {paper} | {ours} |" for package, name, paper, ours in differing]
        lines += [f"| {name} | #Rev | {paper} | {ours} |" for name, paper, ours in revisions if paper != ours]
    else:
        lines += ["Nothing."]
    lines += ["", _MEDIANS, "| row | printed | measured again | corrected | what is corrected |"]
    lines += ["| --- | ---: | ---: | ---: | --- |"]
    printed = {column.key: column for column in COLUMNS}
    raw = _printed()
    for key, own, factor, text in CORRECTED:
        column = printed[key]
        again = faithful.get(f"paper2016.{key}")
        better = corrected.get(own)
        scale = 0.01 if key == "comment_ratio" else 1.0
        cells = (
            written(column)(raw[key].median),
            written(column)(again.median * scale) if again else "",
            written(column)(better.median * factor) if better else "",
        )
        lines.append(f"| {column.title} | {cells[0]} | {cells[1]} | {cells[2]} | {text} |")
    return "\n".join([*lines, "", *_coding_lines(rows, broken), "", _COMMITS])


def broken_of(folder: Path) -> dict[str, Counter[str]]:
    """Return how often packages break coding rules in own code, by package and rule, of the last run by `ros`."""
    with Store.open(folder / ".roslens" / "store.sqlite") as store:
        for run in store.runs():
            view = store.view(run.id)
            if view.header.models == ("ros",):
                return {one.name: coding_findings(one) for one in view.packages()}
    return {}


def coding_findings(package: PackageSummary) -> Counter[str]:
    """Return how often a package breaks each coding rule in own code, in all severities together."""
    found: Counter[str] = Counter()
    for rule in package.rules:
        if rule.gated and "metrics" not in rule.tags:
            found[rule.rule] += rule.gated
    return found


def _coding_lines(rows: Sequence[Mapping[str, str]], broken: Mapping[str, Mapping[str, int]]) -> list[str]:
    """Return the table of the coding rules that are broken most, for each role by its thousand lines."""
    roles = list(ROLES.values())
    lines_of = dict.fromkeys(roles, 0.0)
    counts: dict[str, dict[str, int]] = {}
    packages: dict[str, int] = {}
    for row in rows:
        role = ROLES[int(row["Level"])]
        lines_of[role] += float(row["Cpp LoC"])
        for rule, count in broken.get(row["Package"], {}).items():
            counts.setdefault(rule, dict.fromkeys(roles, 0))[role] += count
            packages[rule] = packages.get(rule, 0) + 1
    most = sorted(counts, key=lambda rule: (-sum(counts[rule].values()), rule))[:MOST_RULES]
    found = [_CODING, f"| rule | findings | packages | {' | '.join(roles)} |", "| --- | ---: | ---: |" + " ---: |" * 3]
    for rule in most:
        each = (f"{counts[rule][role]:,} ({1000 * counts[rule][role] / lines_of[role]:.1f})" for role in roles)
        found.append(f"| `{rule}` | {sum(counts[rule].values()):,} | {packages[rule]} | {' | '.join(each)} |")
    return found


_ABOUT = """\
# The 2016 study, from source

*A Framework for Quality Assessment of ROS Repositories* (Santos, Cunha, Macedo and Lourenço, IROS 2016) measured 180
packages of 45 repositories in October 2015. This page measures the same packages again, from the same commits, and
holds every value against the raw data of the study. The paper's tables from its own data are in
[studies](reference/studies.md), packages of today in [study_2026](study_2026.md).

One command fetches the 48 repositories, measures them twice, compares and writes this page; it ends with the number of
differences. What was fetched or measured is kept, so that after an interruption the same command goes on:

```
python benchmarks/study_2015.py FOLDER
```

It needs the program `cccc` (Debian's package) and `pip install 'roslens[study]'`. Without the network, or where a
repository has moved, `--config FILE` names a configuration with mirrors; the longest prefix that fits is replaced:

```toml
[fetch.rewrite]
"https://github.com/" = "file:///srv/mirrors/"
```

## What is equal
"""
_NOT_AGAIN = """\
CC stands in the raw data with two decimals and is compared to them; means of classes are compared to nine digits, the
maintainability index to six. #DC was typed in by hand, #OI and #CI were counted by a server on that day, and #RCV
came of versions of tools that are not named: these cannot be measured again.
"""
_MEDIANS = """\
## As the study measured, and as it should be

Medians over the same packages: as the paper printed them; as measured here the way the study did (the quality model
`paper2016`: cccc on each file alone, classes with 0 left out); and by the definitions of roslens, where code of others
that lies in a package does not count (Eigen in ecl_eigen, `ikfast.h` in two, `gnuplot-iostream.h` in sr_self_test).
"""
MOST_RULES = 15
_CODING = """\
## Which coding rules are broken most

By the rules of roslens that are on by default, in own code of the same packages; in brackets for a thousand lines of
C++ of the role. The study's own count (#RCV) is of other rules: its five most frequent were tabs, the place of opening
braces, the length of lines, and blanks behind commas and around assignments, which roslens leaves to clang-format.
"""
_COMMITS = """\
## The commits

Of each repository the commit on the branch of the distribution file that has as many ancestors as the raw data says:
`benchmarks/corpora/study_2015.repos`. Three of the 48 (husky, motoman, pr2_delivery) have no package with C++ code in
the raw data; for them the number of commits is that of the study's own list of repositories.
"""


def _printed() -> dict[str, Figures]:
    from roslens.source.study.csv_rows import read_csv
    from roslens.source.study.paper_tables import corpus_of

    corpus = corpus_of(read_csv(RAW))
    with measurements(corpus) as connection:
        return {one.key: one for one in describe(connection, corpus)}


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--config", type=Path, metavar="FILE", help="configuration of the fetch, with mirrors")
    parser.add_argument("--kept", action="store_true", help="fetch and check nothing, take the last runs")
    options = parser.parse_args()
    if not options.kept:
        fetch_and_check(options.folder, options.config)
    with RAW.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    found = values_of(options.folder, "paper2016")
    own = values_of(options.folder, "ros")
    equal, differing = differences(rows, found)
    wanted = {row["Repository"]: int(row["Commits"]) for row in rows}
    listed = yaml.safe_load(LIST.read_text())["repositories"]
    revisions = [(name, wanted[name], commits_of(options.folder / name)) for name in listed if name in wanted]
    again = figures(rows, found, [f"paper2016.{key}" for key, *_ in CORRECTED])
    corrected = figures(rows, own, [one for _, one, *_ in CORRECTED])
    PAGE.write_text(page(rows, equal, differing, revisions, again, corrected, broken_of(options.folder)))
    same = sum(paper == ours for _, paper, ours in revisions)
    print(
        f"{len(differing)} differences in {len(rows)} packages, {same} of {len(revisions)} repositories equal in #Rev"
    )


if __name__ == "__main__":
    main()
