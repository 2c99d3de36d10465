"""The table of docs/reference/standards.md: every check of the study of 2016 and of cpplint has one answer."""

import re

import pytest

from roslens.source.rules.published.standards import CPPLINT, PAPER, answers, asked, standards_page
from roslens.source.rules.table import native_rules

RULES = native_rules()
ROWS = [(whose, name, row) for whose, rows in asked().items() for name, row in rows.items()]
STANDARDS = {
    "cpplint": r"[a-z]+/[a-z0-9_+]+",
    "paper2016": r"[A-Za-z0-9_]+",
    "hicpp": r"\d+\.\d+\.\d+",
    "misra-cpp-2008": r"\d+-\d+-\d+",
    "misra-cpp-2023": r"\d+\.\d+\.\d+",
    "autosar-cpp14": r"[AM]\d+-\d+-\d+",
    "jsf-av": r"\d+(\.\d)?",
    "clang-tidy": r"[a-z0-9]+-[a-zA-Z0-9.-]+",
}


def test_it_has_a_row_for_each_of_the_122_rules_and_66_categories():
    assert len(asked()[PAPER]) == 122
    assert len(asked()[CPPLINT]) == 66
    assert sum(name.startswith("haros") for name in asked()[PAPER]) == 24, "the rules that cppcheck no longer runs"


@pytest.mark.parametrize(("whose", "name", "row"), ROWS, ids=[f"{whose} {name}" for whose, name, _ in ROWS])
def test_every_row_has_one_answer(whose, name, row):
    native = answers(RULES).get(whose, {}).get(name, ())
    given = [bool(native), bool(row.tool), bool(row.why)]
    assert row.what
    assert sum(given) == 1, f"{name}: native {native}, tool {row.tool!r}, why {row.why!r}: expected one of the three"


def test_rules_name_no_row_that_there_is_not():
    for whose, clauses in answers(RULES).items():
        if whose in asked():
            assert clauses.keys() <= asked()[whose].keys(), f"{whose}: {clauses.keys() - asked()[whose].keys()}"


@pytest.mark.parametrize("rule", [rule for rule in RULES.values() if rule.clauses], ids=lambda rule: rule.id)
def test_clauses_are_of_the_form_of_their_standard(rule):
    for clause in rule.clauses:
        standard, _, name = clause.partition(" ")
        if standard in STANDARDS:
            assert re.fullmatch(STANDARDS[standard], name), clause


def test_every_rule_that_the_page_names_exists():
    page = standards_page(RULES)
    named = re.findall(r"\(rules/([\w.]+)\.md\)", page)
    assert len(named) > 200
    assert set(named) <= RULES.keys()
    text = page.replace("](rules/", "")
    assert set(re.findall(r"`(cpp\.\w+)`", text)) <= RULES.keys(), "a reason names a rule that does not exist"


def test_a_profile_of_a_standard_holds_the_rules_that_name_its_clauses():
    for standard in ("hicpp", "misra-cpp-2008", "misra-cpp-2023", "autosar-cpp14", "jsf-av", "paper2016"):
        for clause, ids in answers(RULES)[standard].items():
            for one in ids:
                assert standard in RULES[one].profiles, f"{one} covers {standard} {clause}, but is not on in it"
