"""What is known of a rule since it was mended."""

import msgspec
import pytest

from graph_findings.judgements import NATIVE_TABLES, Judgement, Sample, samples
from graph_findings.mendings import Mending, read_mendings
from graph_findings.standing import BOUND, Standing, enough, standing_of
from roslens.model.finding import Severity
from roslens.source.rules.table import native_rules

TABLES = samples(NATIVE_TABLES)
MENDINGS = read_mendings()
ON = [
    one.id
    for one in native_rules().values()
    if {"ros1", "ros2"} & set(one.profiles) and one.severity is not Severity.NOTE
]
_ENOUGH_TO_JUDGE = 5


def table(seed, exist, *verdicts, repositories=("a/b", "c/d"), developed=False):
    rows = [
        Judgement(repositories[number % len(repositories)], "cpp.a", "warning", "a.cpp", number, "", "m", verdict, "w")
        for number, verdict in enumerate(verdicts)
    ]
    commits = {**dict.fromkeys(repositories, "c"), f"only/{seed}": "c"}
    return Sample(developed, seed, 5, "warning", commits, {}, {"cpp.a": exist} if exist else {}, {}, rows)


@pytest.mark.parametrize("rule", ON)
def test_a_rule_that_warns_by_default_is_true_as_it_is_now(rule):
    known = standing_of(rule, MENDINGS.get(rule), TABLES)
    assert known.read < _ENOUGH_TO_JUDGE or known.true >= BOUND * known.read, (
        f"{rule}: {known.true} of {known.read} read since it was mended are true: mend it, or make it a note"
    )


def test_twenty_of_ten_repositories_are_enough():
    names = [f"a/{number}" for number in range(10)]
    spread = {"one": table(1, 90, *[True] * 20, repositories=names)}
    assert standing_of("cpp.a", None, spread).met
    assert not standing_of("cpp.a", None, {"one": table(1, 90, *[True] * 20)}).met
    assert not standing_of("cpp.a", None, {"one": table(1, 90, *[True] * 19, repositories=names)}).met


def test_all_that_exist_are_enough():
    known = standing_of("cpp.a", None, {"one": table(1, 3, True, True, False), "two": table(2, 1, True)})
    assert known == Standing(true=3, read=4, repositories=2, whole=4, looked_at=4)
    assert known.met
    assert not known.sampled


def test_that_some_were_left_unread_in_the_last_table_is_not_enough():
    known = standing_of("cpp.a", None, {"one": table(1, 1, True), "two": table(2, 9, True)})
    assert known == Standing(true=2, read=2, repositories=1)
    assert not known.met


def test_that_the_last_table_has_none_adds_its_repositories():
    known = standing_of("cpp.a", None, {"one": table(1, 1, True), "two": table(2, 0)})
    assert (known.whole, known.looked_at, known.met, known.absent) == (1, 4, True, False)
    never = standing_of("cpp.a", None, {"one": table(1, 0), "two": table(2, 0)})
    assert (never.looked_at, never.met, never.absent) == (3, False, True)


def test_that_the_last_table_has_none_does_not_hide_what_was_left_unread_before_it():
    known = standing_of("cpp.a", None, {"one": table(1, 1, True), "two": table(2, 9, True), "three": table(3, 0)})
    assert (known.read, known.whole, known.looked_at, known.met) == (2, 0, 0, False)


def test_a_table_on_other_rules_says_nothing():
    other = msgspec.structs.replace(table(2, 0), only=["cpp.b"])
    known = standing_of("cpp.a", None, {"one": table(1, 1, True), "two": other})
    assert (known.read, known.looked_at) == (1, 3)
    same = msgspec.structs.replace(table(2, 0), only=["cpp.a"])
    assert standing_of("cpp.a", None, {"one": table(1, 1, True), "two": same}).looked_at == 4


def test_what_was_read_before_it_was_mended_or_where_it_was_developed_does_not_count():
    found = {"one": table(1, 2, False, False), "two": table(2, 1, True), "own": table(3, 1, False, developed=True)}
    assert standing_of("cpp.a", Mending("one", "why"), found) == Standing(1, 1, 1, 1, 3)
    assert standing_of("cpp.a", Mending("two", "why"), found) == Standing()


def test_enough_is_said_only_of_what_is_true():
    names = [f"a/{number}" for number in range(10)]
    assert enough({"one": table(1, 90, *[True] * 18, False, False, repositories=names)}) == ["cpp.a"]
    assert enough({"one": table(1, 90, *[True] * 17, *[False] * 3, repositories=names)}) == []
