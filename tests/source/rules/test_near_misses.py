"""Each rule that warns by default has, in its fixtures, right code that looks like the mistake and is not reported.

A near miss is a line at which a rule on files looked, by what makes it look, and that it does not report; of a rule on
whole files or packages, a line that shares a word with one that is reported. That nothing else than what is marked is
reported is asked in ``test_every_rule.py``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslens.model.finding import Severity
from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.match_file import _concerns, _find_nodes, _lookouts, _plan
from roslens.source.rules.rule import FileRule, Rule
from roslens.source.rules.table import native_rules
from roslens.source.settings import MacroSettings

FIXTURES = Path(__file__).parents[2] / "fixtures" / "rules"
DEFAULTS = frozenset({"ros1", "ros2"})
FEWEST = 3
ALL_WRONG = frozenset({"cpp.exception_specification"})
"""Rules that look only at what is the mistake itself."""
RULES = [
    rule
    for rule in native_rules().values()
    if rule.severity is not Severity.NOTE and not DEFAULTS.isdisjoint(rule.profiles)
]
MARK = re.compile(r"(//|#|\*)\s*flagged\b(?! lines)")
WORD = re.compile(r"[A-Za-z_]\w*")


def fixtures_of(rule: Rule) -> list[Path]:
    family, name = rule.id.split(".")
    found = {*(FIXTURES / family).rglob(f"{name}.*")}
    for folder in (FIXTURES / family).rglob(name):
        found |= {one for one in folder.rglob("*") if folder.is_dir()}
    return sorted(one for one in found if one.is_file() and one.name != "flagged")


def flagged_in(fixture: Path) -> set[int]:
    """Return the lines of a fixture that are reported, by its own marks or those of its package."""
    lines = fixture.read_text("utf-8", "replace").splitlines()
    found = {number for number, line in enumerate(lines, 1) if MARK.search(line)}
    for match in re.finditer(r"flagged lines: ([\d, ]+)", "\n".join(lines)):
        found.update(map(int, match[1].split(",")))
    for folder in fixture.parents:
        if folder == FIXTURES:
            return found
        if (folder / "flagged").is_file():
            for mark in (folder / "flagged").read_text().split():
                path, _, line = mark.rpartition(":")
                if folder / path == fixture:
                    found.add(int(line))
            return found
    return found


def looked_at(rule: FileRule, fixture: Path) -> Iterator[int]:
    """Yield the lines at which a rule on files looks."""
    language = Language.CPP if rule.syntax == "cpp" else Language.PYTHON
    view = parse_file(fixture.read_bytes(), language, MacroSettings()).view()
    plan = _plan(rule.syntax, frozenset({rule.id}))
    _find_nodes(plan, view)
    for _, nodes in _lookouts(plan.arranged(_concerns(plan, view)), view):
        for node in nodes:
            yield node.start_point[0] + 1


def alike(rule: Rule) -> Iterator[tuple[Path, int]]:
    """Yield the lines that share a word with one that is reported."""
    fixtures = fixtures_of(rule)
    words: set[str] = set()
    for fixture in fixtures:
        lines = fixture.read_text("utf-8", "replace").splitlines()
        for number in flagged_in(fixture):
            words.update(WORD.findall(MARK.sub("", lines[number - 1])) if number <= len(lines) else ())
    for fixture in fixtures:
        for number, line in enumerate(fixture.read_text("utf-8", "replace").splitlines(), 1):
            if words.intersection(WORD.findall(line)):
                yield fixture, number


def near_misses(rule: Rule) -> set[tuple[Path, int]]:
    if isinstance(rule, FileRule) and not rule.whole and rule.id not in ALL_WRONG:
        places = {(fixture, line) for fixture in fixtures_of(rule) for line in looked_at(rule, fixture)}
    else:
        places = set(alike(rule))
    return {(fixture, line) for fixture, line in places if line not in flagged_in(fixture)}


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.id)
def test_right_code_that_looks_like_the_mistake_is_in_its_fixtures(rule):
    found = near_misses(rule)
    assert len(found) >= FEWEST, (
        f"{len(found)} near misses: add right code at which it looks to {[one.name for one in fixtures_of(rule)]}"
    )
