"""What to mend first."""

from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.result import PackageSummary, RuleCount
from roslens.model.tags import TagFilter
from roslens.report.run.fix_first import first_to_fix, is_listed

ALL = TagFilter()


def package(*rules):
    return PackageSummary("a", "a", ".", rules=tuple(rules))


def count(rule, severity=Severity.WARNING, excess=0.0, gated=1, tags=()):
    return RuleCount(rule, severity, 1, gated, f"a.cpp:1: {rule}", tags, excess)


def chosen(*rules, about=None, findings=()):
    return [one.rule for one in first_to_fix([package(*rules)], findings, about or {}, ALL)]


def test_errors_come_before_warnings_and_notes_never():
    assert chosen(count("w"), count("e", Severity.ERROR), count("n", Severity.NOTE)) == ["e", "w"]


def test_what_is_exceeded_further_and_what_is_surer_comes_first():
    assert chosen(count("little", excess=1.5), count("much", excess=30.0)) == ["much", "little"]
    sure = RuleInfo("sure", "t", "d", precision=0.98)
    assert chosen(count("other"), count("sure"), about={"sure": sure}) == ["sure", "other"]


def test_a_limit_of_a_model_waits_for_what_is_plainly_wrong():
    assert chosen(count("limit", excess=4.0, tags=("metrics",)), count("rule")) == ["rule", "limit"]


def test_a_limit_that_is_exceeded_a_thousand_times_waits_too():
    assert chosen(count("limit", excess=4000.0, tags=("metrics",)), count("node.a")) == ["node.a", "limit"]


def test_what_happens_on_the_robot_comes_before_what_happens_in_a_build():
    assert chosen(count("cmake.a"), count("cpp.a"), count("node.a"), count("package.a")) == [
        "node.a",
        "cpp.a",
        "cmake.a",
    ]


def test_three_of_different_rules_that_count():
    rules = [count(f"r{number}") for number in range(5)]
    assert chosen(*rules) == ["r0", "r1", "r2"]
    assert chosen(count("r", gated=0)) == []
    twice = [package(count("r", excess=2.0)), package(count("r", excess=9.0))]
    (one,) = first_to_fix(twice, (), {}, ALL)
    assert one.excess == 9.0


def test_one_limit_at_most_where_there_is_something_else():
    limits = [count(f"m{number}.max", excess=9.0 + number, tags=("metrics",)) for number in range(4)]
    assert chosen(*limits) == ["m3.max", "m2.max", "m1.max"]
    assert chosen(*limits, count("a"), count("b")) == ["m3.max", "a", "b"]
    assert chosen(*limits, count("a")) == ["m3.max", "a", "m2.max"]


def test_nothing_is_not_infinitely_too_little():
    low = count("comment_ratio.min", excess=20.0, tags=("metrics",))
    assert chosen(low, count("eloc.max", excess=2.0, tags=("metrics",)))[0] == "eloc.max"


def test_what_belongs_to_no_package_takes_part():
    finding = Finding("graph.qos", Severity.ERROR, "never connected", "a.launch", 3)
    (one,) = first_to_fix([], [finding], {}, ALL)
    assert one.example == "a.launch:3: never connected"


def test_a_row_tells_of_a_mistake_or_of_a_limit_that_is_far_exceeded():
    assert is_listed(count("cpp.a"))
    assert is_listed(count("function_limits", excess=16.0, tags=("metrics",)))
    assert not is_listed(count("cbo.max", excess=15.9, tags=("metrics",)))
    assert not is_listed(count("comment_ratio.min", excess=99.0, tags=("metrics",)))


def test_what_changes_often_comes_before_what_nobody_touches():
    busy = RuleCount("cmake.a", Severity.WARNING, 1, 1, "b.cpp:1: b", path="b.cpp")
    rules = [package(count("cmake.0"), busy)]
    assert [one.rule for one in first_to_fix(rules, [], {}, ALL)] == ["cmake.0", "cmake.a"]
    assert [one.rule for one in first_to_fix(rules, [], {}, ALL, {"b.cpp": 3})] == ["cmake.a", "cmake.0"]


def test_no_number_of_commits_makes_a_warning_more_urgent_than_an_error():
    busy = RuleCount("node.a", Severity.WARNING, 1, 1, "b.cpp:1: b", path="b.cpp", excess=16.0)
    first, _ = first_to_fix([package(busy, count("cmake.e", Severity.ERROR))], [], {}, ALL, {"b.cpp": 9999})
    assert first.rule == "cmake.e"
