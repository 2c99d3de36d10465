"""The raw tables of the 2016 study, as the tool HAROS wrote them in October 2015, as a corpus.

One table has a row for each package and a column for each row of the paper's Table II, the other a row for each rule
that a package breaks. What the columns mean and which limits belong to them is from the paper and from the rules of
that version of the tool. Metrics of the process are those of repositories: a repository's are repeated in each of its
packages, and counted once.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from roslens.model.errors import UsageError
from roslens.model.source import Location
from roslens.model.study import REPOSITORY, Broken, Column, Corpus, Subject
from roslens.source.study.csv_rows import CsvRows

KIND = "paper2016"
ROLES = {1: "driver", 2: "library", 3: "application"}
"""What the paper calls the levels 1 to 3 of its tables."""

SIZE = "loc"
_PACKAGES = {
    "Level": Column("role", "Role", decimals=2),
    "Cpp LoC": Column(SIZE, "LOC", "lines", size=True),
    "Cpp LoCom": Column("comment_lines", "LOCom", "lines", size=True),
    "Com Ratio": Column("comment_ratio", "%Com", minimum=0.2, threshold="> 0.2"),
    "CC": Column("cyclomatic_complexity", "CC", minimum=1, maximum=15, threshold="1..15"),
    "Maintainability": Column("maintainability_index", "MI", minimum=0, maximum=100, threshold="0..100"),
    "CBO": Column("cbo", "CBO", minimum=0, maximum=5, threshold="0..5"),
    "WMC": Column("wmc", "WMC", minimum=1, maximum=100, threshold="1..100"),
    "MAC": Column("mac", "MAC", minimum=1, maximum=20, threshold="1..20"),
    "Dependency of": Column("dependents", "#Dep", "packages"),
    "Metrics Violations": Column("rqv", "#RQV", "findings", size=True),
    "Standards Violations": Column("rcv", "#RCV", "findings", size=True),
}
_REPOSITORIES = {
    "Commits": Column("revisions", "#Rev", "commits", of=REPOSITORY),
    "Contributors": Column("contributors", "#DC", "people", of=REPOSITORY),
    "Open issues": Column("open_issues", "#OI", "issues", of=REPOSITORY),
    "Closed issues": Column("closed_issues", "#CI", "issues", of=REPOSITORY),
}
COLUMNS = (*_PACKAGES.values(), *_REPOSITORIES.values())
"""Rows of Table II, in its order."""

METRIC_RULES = {
    "MIN_COM_RATIO": "comment ratio below 20 %",
    "MAX_COUPLING": "CBO above 5",
    "MAX_CC": "CC above 15",
    "MAX_AVAILABLE_METHODS": "MAC above 20",
    "MAX_WEIGHT_METHODS": "WMC above 100",
    "MAX_CHILDREN": "NOC above 10",
}
"""Rules of the paper's quality model that were measured, by their names in the table."""


def is_package_table(head: Sequence[str]) -> bool:
    """Return whether a header is that of the table of packages."""
    return {"Package", "Repository", *_PACKAGES, *_REPOSITORIES} <= set(head)


def is_rule_table(head: Sequence[str]) -> bool:
    """Return whether a header is that of the table of rules."""
    return {"Package", "Level", "Rule", "Violations"} <= set(head)


def corpus_of(packages: CsvRows, rules: Iterable[CsvRows] = ()) -> Corpus:
    """Return the corpus of a table of packages and tables of the rules that they break.

    Raises:
        UsageError: a cell is no number, a level is none of three, a package is there twice, or packages of one
            repository disagree about it.
    """
    subjects: list[Subject] = []
    repositories: dict[str, Subject] = {}
    seen: set[str] = set()
    for line, row in packages.dictionaries():
        name, repository = row["Package"], row["Repository"]
        if name in seen:
            raise UsageError(f'a second row of "{name}"', where=Location(packages.path, line), expected="one row each")
        seen.add(name)
        own = {one.key: packages.number(line, head, row[head]) for head, one in _PACKAGES.items()}
        role = _role(own["role"], packages.path, line)
        subjects.append(Subject(name, repository, role, values=own))
        process = {one.key: packages.number(line, head, row[head]) for head, one in _REPOSITORIES.items()}
        before = repositories.setdefault(repository, Subject(repository, repository, values=process))
        if before.values != process:
            raise UsageError(
                f'"{repository}" has other figures in this row than in one before',
                where=Location(packages.path, line),
                expected="the same commits, contributors and issues in each row of a repository",
            )
    rules = tuple(rules)
    return Corpus(
        KIND,
        (packages.path, *(one.path for one in rules)),
        COLUMNS,
        tuple(subjects),
        tuple(repositories.values()),
        tuple(broken for table in rules for broken in _broken(table)),
        SIZE,
    )


def _broken(table: CsvRows) -> Iterable[Broken]:
    for line, row in table.dictionaries():
        role = _role(table.number(line, "Level", row["Level"]), table.path, line)
        count = int(table.number(line, "Violations", row["Violations"]))
        rule = row["Rule"]
        yield Broken(rule, row["Package"], role, count, "metric" if rule in METRIC_RULES else "coding")


def _role(level: float, path: str, line: int) -> str:
    if level not in ROLES:
        expected = ", ".join(f"{number} ({role})" for number, role in ROLES.items())
        raise UsageError(f'the level "{level:g}"', where=Location(path, line), expected=expected)
    return ROLES[int(level)]
