"""What several rules report of one place is one finding that names them all."""

import pytest

from roslens.model.finding import Finding, Severity
from roslens.source.rules.table import FAMILIES, native_rules
from roslens.source.tools.used import TOOLS
from roslens.source.tools.witnesses import all_equivalents, equivalents, joined

EXPLICIT = ("cpp.explicit_constructor", "cpplint.runtime/explicit", "cppcheck.noExplicitConstructor")


def finding(rule, line=7, column=0, path="a.hpp"):
    return Finding(rule, Severity.WARNING, f"says {rule}", path, line, column)


def reported(findings):
    return [(one.rule, one.line, one.witnesses) for one in joined(findings)]


def test_the_first_of_a_row_stands_and_names_the_others():
    native, cpplint, cppcheck = EXPLICIT
    assert reported([finding(cppcheck), finding(cpplint), finding(native)]) == [(native, 7, (cpplint, cppcheck))]
    assert reported([finding(cppcheck), finding(cpplint)]) == [(cpplint, 7, (cppcheck,))]


def test_another_line_or_file_is_another_finding():
    native, cpplint, _ = EXPLICIT
    given = [finding(native), finding(cpplint, line=8), finding(cpplint, path="b.hpp")]
    assert joined(given) == tuple(given)


def test_rules_that_are_not_the_same_stay_apart():
    given = [finding("cpplint.runtime/int"), finding("cpplint.runtime/explicit"), finding("mine.rule")]
    assert joined(given) == tuple(given)


def test_the_second_of_one_is_the_second_of_the_other():
    given = [
        finding("ruff.F401", 2, 8),
        finding("ruff.F401", 2, 13),
        finding("pylint.unused-import", 2, 1),
        finding("pylint.unused-import", 2, 1),
        finding("ament_flake8.F401", 2, 1),
    ]
    assert reported(given) == [
        ("ruff.F401", 2, ("ament_flake8.F401", "pylint.unused-import")),
        ("ruff.F401", 2, ("pylint.unused-import",)),
    ]


def test_what_concerns_a_file_is_one_whatever_line_is_named():
    given = [finding("ruff.syntax-error", 3), finding("pylint.syntax-error", 5)]
    assert reported(given) == [("ruff.syntax-error", 3, ("pylint.syntax-error",))]


def test_nothing_is_lost():
    rules = [rule for row in equivalents() for rule in row.rules]
    given = [finding(rule, line) for line in (1, 2) for rule in rules]
    whole = [one for kept in joined(given) for one in (kept.rule, *kept.witnesses)]
    assert sorted(whole) == sorted([*rules, *rules])


def test_the_clauses_of_a_native_rule_are_checks_that_are_the_same():
    rows = {row.rules[0]: row.rules for row in all_equivalents()}
    assert rows["cpp.missing_default"] == ("cpp.missing_default", "clang_tidy.hicpp-multiway-paths-covered")
    assert reported([finding("clang_tidy.hicpp-multiway-paths-covered"), finding("cpp.missing_default")]) == [
        ("cpp.missing_default", 7, ("clang_tidy.hicpp-multiway-paths-covered",))
    ]


def test_what_tools_say_alike_is_handed_on_to_the_native_rule_that_knows_one_of_them():
    (native,) = (
        row
        for row in all_equivalents()
        if "pylint.dangerous-default-value" in row.rules[1:]
        and "ruff.B006" in row.rules
        and row.rules[0] in native_rules()
    )
    given = [
        finding("ruff.B006"),
        finding("ament_flake8.B006"),
        finding("pylint.dangerous-default-value"),
        finding(native.rules[0]),
    ]
    (one,) = joined(given)
    assert one.rule == native.rules[0]
    assert sorted(one.witnesses) == ["ament_flake8.B006", "pylint.dangerous-default-value", "ruff.B006"]


def test_a_check_that_two_native_rules_name_is_a_witness_of_the_one_that_is_there():
    naming = "clang_tidy.readability-identifier-naming"
    given = [finding(naming, 1), finding(naming, 2), finding("cpp.class_name", 1), finding("cpp.function_name", 2)]
    assert reported(given) == [("cpp.class_name", 1, (naming,)), ("cpp.function_name", 2, (naming,))]


def test_without_tools_nothing_is_looked_at():
    given = [finding("cpp.explicit_constructor"), finding("ros.cbo.max")]
    assert joined(given) == tuple(given)


def test_a_rule_is_in_one_row():
    rules = [rule for row in equivalents() for rule in row.rules]
    assert len(rules) == len(set(rules))


@pytest.mark.parametrize("row", equivalents(), ids=lambda row: row.about)
def test_a_row_names_rules_that_there_are(row):
    assert len(row.rules) > 1
    for rule in row.rules:
        family, _, check = rule.partition(".")
        assert check
        assert family in TOOLS or (family in FAMILIES and rule in native_rules()), rule
    tools = [rule.partition(".")[0] for rule in row.rules]
    native = [tool in FAMILIES for tool in tools]
    assert sorted(native, reverse=True) == native, "roslens' own rule comes first"
