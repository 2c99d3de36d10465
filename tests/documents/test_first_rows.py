"""The counts of docs/first_rows.md are those of its tables."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from typing import NamedTuple

import pytest

NO_ROW = "\N{EN DASH}"
PAGE = Path(__file__).parents[2] / "docs/first_rows.md"
COUNTED = ("rows", "rows that are true", "rows worth acting on", "first row worth acting on")


class Row(NamedTuple):
    repository: str
    number: str
    rule: str
    true: str
    worth: str


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip("|").split(" | ")]


def rounds() -> dict[str, list[Row]]:
    found: dict[str, list[Row]] = {}
    for number, body in re.findall(
        r"^## Round (\d), every row\n(.*?)(?=^## |\Z)", PAGE.read_text("utf-8"), re.DOTALL | re.MULTILINE
    ):
        lines = [cells(line) for line in body.splitlines() if line.startswith("| ")][2:]
        for line in lines:
            assert len(line) == 7, f"seven cells, none with ' | ' in it: {line}"
        found[number] = [Row(one[0], one[1], one[2].removesuffix(" ✖"), one[4], one[5]) for one in lines]
    return found


def summary(number: str) -> dict[str, int]:
    lines = [cells(line) for line in PAGE.read_text("utf-8").splitlines() if line.startswith("| ")]
    at = lines[0].index(f"round {number}")
    return {line[0]: int(re.match(r"\d+", line[at])[0]) for line in lines[1:] if line[0] in COUNTED}  # type: ignore[index]


@pytest.mark.parametrize("number", rounds())
def test_the_summary_counts_what_the_table_has(number: str) -> None:
    rows = [row for row in rounds()[number] if row.number != NO_ROW]
    assert {row.true for row in rows} | {row.worth for row in rows} <= {"yes", "no"}
    assert summary(number) == {
        "rows": len(rows),
        "rows that are true": sum(row.true == "yes" for row in rows),
        "rows worth acting on": sum(row.worth == "yes" for row in rows),
        "first row worth acting on": sum(row.worth == "yes" for row in rows if row.number == "1"),
    }


def test_each_rule_is_counted_over_all_rounds() -> None:
    rows = [row for table in rounds().values() for row in table if row.number != NO_ROW]
    counted = {rule: (count, 0) for rule, count in Counter(row.rule for row in rows).items()}
    for rule, count in Counter(row.rule for row in rows if row.worth == "yes").items():
        counted[rule] = (counted[rule][0], count)
    body = PAGE.read_text("utf-8").partition("## By rule\n")[2].partition("\n## ")[0]
    lines = [cells(line) for line in body.splitlines() if line.startswith("| ")][2:]
    assert {line[0]: (int(line[1]), int(line[2])) for line in lines} == counted
