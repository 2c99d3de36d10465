"""What to mend first."""

import msgspec

from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.result import PackageSummary, RuleCount
from roslens.model.tags import TagFilter
from roslens.model.weight.consequence import Certainty, Consequence
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


def weighed(rule, consequence, certainty=Certainty.LIKELY, line=0, path="", severity=Severity.WARNING):
    place = f"{path or rule}:{line}: {rule}"
    return RuleCount(
        rule, severity, 1, 1, place, path=path, consequence=consequence, certainty=certainty, line=line
    )  # fmt: skip


def test_what_has_a_worse_consequence_comes_first_whatever_its_severity():
    rows = [
        weighed("y", Consequence.HARD_TO_MAINTAIN, Certainty.PROVEN),
        weighed("m", Consequence.MAY_BE_WRONG),
        weighed("w", Consequence.WRONG, Certainty.PROVEN, severity=Severity.ERROR),
        weighed("s", Consequence.STOPS_START),
        weighed("b", Consequence.STOPS_BUILD),
    ]
    assert chosen(*rows) == ["b", "s", "w", "m", "y"]


def test_of_one_consequence_what_is_surer_comes_first_then_what_was_measured_to_be_true_more_often():
    likely, proven = weighed("a", Consequence.WRONG), weighed("b", Consequence.WRONG, Certainty.PROVEN)
    assert chosen(likely, proven) == ["b", "a"]
    sure = RuleInfo("sure", "t", "d", precision=0.98)
    assert chosen(count("other"), count("sure"), about={"sure": sure}) == ["sure", "other"]


def test_a_limit_of_a_model_waits_for_what_is_plainly_wrong():
    assert chosen(count("limit", excess=4.0, tags=("metrics",)), count("rule")) == ["rule", "limit"]


def test_a_limit_that_is_exceeded_a_thousand_times_waits_too():
    assert chosen(count("limit", excess=4000.0, tags=("metrics",)), count("node.a")) == ["node.a", "limit"]


def test_ten_rows_that_count():
    rules = [count(f"r{number:02}") for number in range(15)]
    assert chosen(*rules) == [f"r{number:02}" for number in range(10)]
    assert chosen(count("r", gated=0)) == []


def test_no_two_of_one_rule_stand_beside_each_other_and_a_rule_has_three_rows_at_most():
    many = [weighed("a", Consequence.WRONG, line=line, path=f"a{line}.cpp") for line in range(1, 9)]
    few = [weighed("b", Consequence.MAY_BE_WRONG, line=line, path=f"b{line}.cpp") for line in range(1, 3)]
    assert chosen(*many, *few) == ["a", "b", "a", "b", "a"]
    assert chosen(*many) == ["a", "a", "a"]


def test_a_limit_is_the_last_row_and_never_the_first():
    limits = [count(f"m{number}.max", excess=9.0 + number, tags=("metrics",)) for number in range(4)]
    assert chosen(*limits) == []
    assert chosen(*limits, count("a"), count("b")) == ["a", "b", "m3.max"]
    assert chosen(*limits, *(count(f"r{number:02}") for number in range(12)))[8:] == ["r08", "m3.max"]


def test_a_line_that_two_rules_report_is_one_row():
    first = weighed("a", Consequence.WRONG, line=3, path="a.cpp")
    second = weighed("b", Consequence.MAY_BE_WRONG, line=3, path="a.cpp")
    elsewhere = weighed("b", Consequence.MAY_BE_WRONG, line=4, path="a.cpp")
    rows = first_to_fix([package(second, first, elsewhere)], (), {}, ALL)
    assert [(one.rule, one.also) for one in rows] == [("a", ("b",)), ("b", ())]
    unknown = [weighed("a", Consequence.WRONG, path="a.cpp"), weighed("b", Consequence.WRONG, path="a.cpp")]
    assert chosen(*unknown) == ["a", "b"]


def test_the_same_place_in_a_copy_of_its_folder_is_no_further_row():
    def row(path, user):
        place = f"{path}:7: {user} uses it"
        return RuleCount("d", Severity.WARNING, 1, 1, place, path=path, line=7)

    copies = [row(f"{at}/bot_gazebo/a.xml", f"{at}/bot_gazebo/CMakeLists.txt:3") for at in ("ch9/bot/bot", "ch9/bot")]
    other = row("ch9/bot/bot_arm/a.xml", "ch9/bot/bot_arm/CMakeLists.txt:3")
    rows = first_to_fix([package(*copies, other)], (), {}, ALL)
    assert [(one.path, one.alike) for one in rows] == [
        ("ch9/bot/bot/bot_gazebo/a.xml", 1),
        ("ch9/bot/bot_arm/a.xml", 0),
    ]


def test_what_is_said_alike_of_several_places_is_one_row_that_counts_them():
    def row(path, message, consequence):
        place = f"{path}:7: {message}"
        return RuleCount(
            "d", Severity.WARNING, 1, 1, place, path=path, line=7, consequence=consequence, certainty=Certainty.PROVEN
        )

    def shown(consequence):
        rows = [row(path, "no licence", consequence) for path in ("a", "b", "c")]
        other = row("d", "no licence at all", consequence)
        return [(one.path, one.alike) for one in first_to_fix([package(*rows, other)], (), {}, ALL)]

    assert shown(Consequence.HARD_TO_MAINTAIN) == [("a", 2), ("d", 0)]
    assert shown(Consequence.MAY_BE_WRONG) == [("a", 0), ("b", 0), ("c", 0)]


def test_what_one_file_has_several_times_but_for_names_is_one_row():
    def undefined(path, name, line, more=""):
        text = f"{path}:{line}: `{name}` is not defined: a NameError where it is read{more}; expected its import"
        return RuleCount("python.name", Severity.WARNING, 1, 1, text, path=path, line=line)

    rows = [
        undefined("a.py", "left", 3),
        undefined("a.py", "right", 5, ", here and 3 times more"),
        undefined("b.py", "left", 3),
    ]
    assert [(one.path, one.alike) for one in first_to_fix([package(*rows)], (), {}, ALL)] == [("a.py", 1), ("b.py", 0)]


def test_names_that_a_distribution_took_from_one_package_are_one_row():
    def row(rule, path, name, tag):
        message = f"{path}:7: plug-in `{name}` is removed in Humble"
        return RuleCount(
            rule, Severity.WARNING, 1, 1, message, (tag,), path=path, line=7,
            consequence=Consequence.STOPS_START, certainty=Certainty.LIKELY,
        )  # fmt: skip

    rows = [
        row("g", "a.yaml", "nav2_recoveries/Spin", "distribution"),
        row("g", "b.yaml", "nav2_recoveries/Wait", "distribution"),
        row("g", "b.yaml", "dwb_core::Local", "distribution"),
        row("h", "c.cpp", "rclcpp::executor::Args", "deprecated"),
        row("h", "d.cpp", "rclcpp::executor::Args", "deprecated"),
        row("h", "d.cpp", "rclcpp::Other", "deprecated"),
    ]
    rows = [msgspec.structs.replace(one, line=number) for number, one in enumerate(rows, 1)]
    found = [(one.path, one.line, one.alike) for one in first_to_fix([package(*rows)], (), {}, ALL)]
    assert sorted(found) == [("a.yaml", 1, 1), ("b.yaml", 3, 0), ("c.cpp", 4, 1), ("d.cpp", 6, 0)]


def test_each_grave_finding_takes_part_and_not_the_example_of_its_rule_alone():
    def grave(line, path="a.cpp"):
        return Finding(
            "node.a", Severity.WARNING, "m", path, line, consequence=Consequence.WRONG, certainty=Certainty.LIKELY
        )

    summary = package(weighed("node.a", Consequence.WRONG, line=1, path="a.cpp"), count("cpp.a"))
    rows = first_to_fix([summary], (), {}, ALL, grave=[grave(1), grave(7, "b.cpp")])
    assert [(one.rule, one.line) for one in rows] == [("node.a", 1), ("cpp.a", 0), ("node.a", 7)]


def test_nothing_is_not_infinitely_too_little():
    low = count("comment_ratio.min", excess=20.0, tags=("metrics",))
    far = count("eloc.max", excess=2.0, tags=("metrics",))
    assert chosen(low, far, count("a"))[-1] == "eloc.max"


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
