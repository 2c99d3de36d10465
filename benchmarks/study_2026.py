"""ROS code of today beside that of the 2016 study, by the study's own measures; writes docs/study_2026.md.

    python benchmarks/study_2026.py FOLDER                    fetch and check FOLDER/2015, FOLDER/ros1 and FOLDER/ros2
    python benchmarks/study_2026.py FOLDER --config FILE      the same from mirrors, named under [fetch.rewrite] in FILE
    python benchmarks/study_2026.py FOLDER --kept             of the clones and runs that are there

The repositories are those of benchmarks/corpora: study_2015.repos, field_ros1.repos, and of field_ros2.repos those
whose commit is of 2022 or later. One that is not there, or at another commit, is left out, and the page says so. What
was fetched or measured is kept: after an interruption the same command goes on. Needs the program cccc and
`pip install 'roslens[study]'`.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import msgspec
import yaml
from study_2026_tables import ROWS, TITLES, changed, correlations, figures_of, roles, rules, shares, table
from study_2026_today import Today, coding, definitions, lasting, today_of

from roslens.children.git import git_environment, git_words
from roslens.cli.main import main as roslens_main
from roslens.model.result import PackageSummary
from roslens.model.source import OUTSIDE_PACKAGES
from roslens.model.study import PACKAGE, Broken, Corpus, Subject
from roslens.source.study.csv_rows import read_csv
from roslens.source.study.paper_tables import corpus_of
from roslens.source.study.role import decide, facts_of
from roslens.store.read import RunView
from roslens.store.runs import Store

ROOT = Path(__file__).parents[1]
LISTS = {
    name: ROOT / "benchmarks" / "corpora" / f"{file}.repos"
    for name, file in (("2015", "study_2015"), ("ros1", "field_ros1"), ("ros2", "field_ros2"))
}
RAW = ROOT / "tests" / "fixtures" / "study" / "package_repo_metrics.csv"
PAGE = ROOT / "docs" / "study_2026.md"
SINCE = "2022-01-01"


class LeftOut(msgspec.Struct, frozen=True):
    """What a corpus is without: repositories, each with the reason, and packages of which cccc has no values."""

    repositories: Mapping[str, str]
    packages: tuple[str, ...]


def fetch_and_check(folder: Path, configuration: Path | None) -> None:
    """Fetch all three lists and check them as the study did, and as roslens does; say what each step took."""
    named = ["--config", str(configuration)] if configuration else []
    for name, path in LISTS.items():
        roslens_main(["fetch", "--distribution", str(path), "--into", str(folder / name), *named])
        for model in ("paper2016", "ros"):
            begun = time.monotonic()
            options = ["--model", model, "--tools", "none", "--fail-on", "never", "-o", str(folder / f"{name}.md")]
            roslens_main(["check", str(folder / name), *options])
            print(f"{name} checked by {model} in {time.monotonic() - begun:.0f} s", flush=True)


def git(folder: Path, command: str, *words: str) -> str:
    """Return what git says of a clone."""
    asked = git_words(str(folder), command, *words)
    return subprocess.run(asked, env=git_environment(os.environ), capture_output=True, text=True, check=True).stdout


def repositories_of(
    folder: Path, wanted: Mapping[str, Mapping[str, str]], since: str
) -> tuple[dict[str, Subject], dict[str, str]]:
    """Return each repository with its commits and contributors, and why others are left out.

    Args:
        folder: that has a folder of clones for each list.
        wanted: the repositories of a list.
        since: the day before which a commit is too old.
    """
    found, left_out = {}, {}
    for name, one in wanted.items():
        clone = next((there for list_ in LISTS if (there := folder / list_ / name).is_dir()), None)
        why = _unfit(clone, one["version"], since)
        if clone is None or why:
            left_out[name] = why
            continue
        people = {line for line in git(clone, "log", "--format=%aN", "HEAD").splitlines() if line}
        commits = int(git(clone, "rev-list", "--count", "HEAD"))
        values = {"revisions": float(commits), "contributors": float(len(people))}
        found[name] = Subject(name, name, values=values)
    return found, left_out


def _unfit(clone: Path | None, version: str, since: str) -> str:
    if clone is None:
        return "it could not be fetched"
    commit, day = git(clone, "log", "-1", "--format=%H %cs").split()
    if not commit.startswith(version):
        return f"it is at {commit[:12]}, not at {version[:12]}"
    return f"its commit is of {day}" if day < since else ""


def corpus_from(folder: Path, path: Path, since: str = "") -> tuple[Corpus, LeftOut]:
    """Return the packages with C and C++ code of a list's repositories, as Table II has them, and what is left out.

    They are looked for in the last runs by `paper2016` of all three folders.
    """
    repositories, without = repositories_of(folder, yaml.safe_load(path.read_text())["repositories"], since)
    packages: list[Subject] = []
    broken: list[Broken] = []
    unmeasured: list[str] = []
    for view in views(folder, "paper2016"):
        for summary in view.packages():
            if summary.id == OUTSIDE_PACKAGES or summary.repository not in repositories:
                continue
            values, result = _values(summary), view.package(summary.id)
            if result and any(one.tool == "cccc" for one in result.failures):
                unmeasured.append(summary.id)
            if "loc" not in values:
                continue
            role = decide(facts_of(result)).role if result else ""
            packages.append(Subject(summary.id, summary.repository, role, values=values))
            rules = [rule for rule in summary.rules if "metrics" in rule.tags]
            broken += [Broken(rule.rule, summary.id, role, rule.count) for rule in rules]
    used = {one.repository for one in packages}
    kept = tuple(one for name, one in repositories.items() if name in used)
    without |= dict.fromkeys(sorted(set(repositories) - used), "it has no package with C or C++ that was measured")
    corpus = Corpus("runs", (str(path),), ROWS, tuple(packages), kept, tuple(broken), "loc")
    return corpus, LeftOut(without, tuple(sorted(unmeasured)))


def views(folder: Path, model: str) -> Iterator[RunView]:
    """Lend the last run by one model alone of each folder, as far as there is one."""
    for one in LISTS:
        with Store.open(folder / one / ".roslens" / "store.sqlite") as store:
            run = next((run.id for run in store.runs() if run.header.models == (model,)), None)
            if run is not None:
                yield store.view(run)


def _values(summary: PackageSummary) -> dict[str, float]:
    found = {key.partition(".")[2]: value for key, value in summary.values.items() if key.startswith("paper2016.")}
    if "comment_ratio" in found:
        found["comment_ratio"] /= 100
    if "dependents" in summary.values:
        found["dependents"] = summary.values["dependents"]
    return {column.key: found[column.key] for column in ROWS if column.of == PACKAGE and column.key in found}


def studied(corpus: Corpus) -> Corpus:
    """Return what of the study's repositories its authors looked at."""
    names = {one.name for one in corpus_of(read_csv(RAW)).packages}
    packages = tuple(one for one in corpus.packages if one.name in names)
    used = {one.repository for one in packages}
    return msgspec.structs.replace(
        corpus,
        packages=packages,
        repositories=tuple(one for one in corpus.repositories if one.name in used),
        broken=tuple(one for one in corpus.broken if one.package in names),
    )


def absent(without: Mapping[str, LeftOut]) -> list[str]:
    """Return what the corpora are without, and why."""
    lines = []
    for name, one in without.items():
        many = len(one.repositories)
        lines.append(f"- {TITLES[name]}: {many} {'repository' if many == 1 else 'repositories'} of the list.")
        lines += [f"  - `{repository}`: {why}." for repository, why in sorted(one.repositories.items())]
        if one.packages:
            named = ", ".join(f"`{package}`" for package in one.packages)
            lines.append(f"  - {len(one.packages)} packages have no values, since cccc has none of a file: {named}.")
    return lines


def page(
    corpora: Mapping[str, Corpus], without: Mapping[str, LeftOut], today: Mapping[str, Today], checked: str
) -> str:
    """Return the page; ``checked`` says when the runs were."""
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
                "",
                f"Checked on {checked} by the rules and definitions of that day; what is left out stands at the end.",
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
        _TODAY,
        "\n".join([*definitions(today, TITLES), "", *lasting(today, TITLES)]),
        _CODING,
        "\n".join(coding(today, TITLES)),
        _ABSENT,
        "\n".join(absent(without)),
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

_TODAY = """
## By the definitions of roslens

Medians (quartiles) over the same packages by the quality model `ros`: C, C++ and Python; every function and class
once, 0 included; classes of all files of a package see each other; code of others that lies in a package, and tests,
left out. [study.md](study.md) says of each row what is different from the paper's. The last columns are Cliff's delta
as above.
"""
_CODING = """
## Coding rules that are broken most

By the rules of roslens that are on by default, in own code of the same packages. Each cell: findings (for each 1,000
lines of C, C++ and Python; packages that have any). Rules about ROS 1 or ROS 2 alone look at packages of theirs.
"""
_ABSENT = """
## What is left out

What a list names and the tables are without: repositories that could not be fetched or are too old, those without a
package that has C or C++, and packages of which cccc has no values, as it did not end with a file in 20 s or crashed.
"""


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--config", type=Path, metavar="FILE", help="configuration of the fetch, with mirrors")
    parser.add_argument("--kept", action="store_true", help="fetch and check nothing, take the last runs")
    options = parser.parse_args()
    if not options.kept:
        fetch_and_check(options.folder, options.config)
    found = {name: corpus_from(options.folder, path, SINCE if name == "ros2" else "") for name, path in LISTS.items()}
    corpora = {name: corpus for name, (corpus, _) in found.items()} | {"2015": studied(found["2015"][0])}
    summaries = [one for view in views(options.folder, "ros") for one in view.packages()]
    today = {name: today_of(corpus, summaries) for name, corpus in corpora.items()}
    checked = max(view.header.started[:10] for view in views(options.folder, "ros"))
    PAGE.write_text(page(corpora, {name: without for name, (_, without) in found.items()}, today, checked))
    for name, corpus in corpora.items():
        left = len(found[name][1].repositories)
        print(
            f"{TITLES[name]}: {len(corpus.packages)} packages of {len(corpus.repositories)} repositories, "
            f"{left} of the list left out"
        )


if __name__ == "__main__":
    main()
