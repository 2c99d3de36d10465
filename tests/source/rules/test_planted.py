"""Recall: the example of each rule on C++ is found behind the code of others, and with the line ends of Windows.

A rule that reads a whole file (whether it has a guard, whose it is) has no place to be planted at.
"""

from pathlib import Path

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.match_file import match_file
from roslens.source.rules.rule import FileRule
from roslens.source.rules.table import native_rules
from roslens.source.settings import MacroSettings

FIXTURES = Path(__file__).parents[2] / "fixtures" / "rules" / "cpp"
HOSTS = (
    "classes/override.cpp",
    "control/fallthrough.cpp",
    "exceptions/catch_by_value.cpp",
    "declarations/header_variable.hpp",
)
OF_WHOLE_FILES = {"cpp.guard", "cpp.copyright"}
RULES = [
    rule
    for rule in native_rules().values()
    if isinstance(rule, FileRule) and rule.family == "cpp" and rule.id not in OF_WHOLE_FILES
]


def lines_of(rule, content):
    matched = match_file(parse_file(content, Language.CPP, MacroSettings()).view(), frozenset({rule.id}))
    return {hit.line for hit in matched.hits if hit.rule == rule.id}


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.id)
def test_an_example_is_found_behind_the_code_of_others(rule):
    for host in HOSTS:
        path = FIXTURES / host
        if not path.is_file():
            continue
        before = b"#pragma once\n" + path.read_bytes()
        planted = before + rule.bad.encode()
        assert max(lines_of(rule, planted), default=0) > before.count(b"\n"), host


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.id)
def test_an_example_is_found_with_the_line_ends_of_windows(rule):
    assert lines_of(rule, rule.bad.replace("\n", "\r\n").encode()) == lines_of(rule, rule.bad.encode())
