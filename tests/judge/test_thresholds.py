"""Values against thresholds: which findings there are and what they say."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.judge.quality.constraint import Constraint
from roslens.judge.quality.quality_model import QualityModel, rules_of
from roslens.judge.quality.thresholds import Rated, judge_entities, rate_values
from roslens.judge.ranges.range import Range
from roslens.judge.ranges.rate import rate
from roslens.model.entity import Entity, EntityKind
from roslens.model.finding import Finding, Severity, fingerprint
from roslens.model.verdict import State
from roslens.model.weight.consequence import Certainty, Consequence

CC = "cyclomatic_complexity"


def constraint(quantity: str, minimum: float | None, maximum: float | None, **more: object) -> Constraint:
    kind = more.pop("kind", EntityKind.FUNCTION)
    return Constraint(quantity, kind, quantity, Range(minimum, maximum), **more)  # type: ignore[arg-type]


ROS = QualityModel(
    "ros",
    constraints=(
        constraint(CC, None, 15, subject="Cyclomatic complexity", tags=("complexity",), severity=Severity.ERROR),
        constraint("comment_ratio", 20, 40, kind=EntityKind.FILE, subject="Comment ratio", unit="%"),
    ),
)
HIS = QualityModel("his", constraints=(constraint(CC, None, 10), constraint("nesting", None, 4, name="n::*")))


def function(values: dict[str, float], name: str = "Foo::bar", line: int = 10) -> Entity:
    return Entity(
        f"function:a.cpp#{name}()", EntityKind.FUNCTION, name, "a.cpp", line, line + 5, "file:a.cpp", values=values
    )


def test_a_finding_carries_everything():
    (finding,) = judge_entities([ROS], [function({CC: 23.0})])
    assert finding == Finding(
        rule="ros.cyclomatic_complexity.max",
        severity=Severity.ERROR,
        message="cyclomatic complexity 23 (limit 15, 1.5 x) in Foo::bar",
        path="a.cpp",
        line=10,
        end_line=15,
        entity="function:a.cpp#Foo::bar()",
        tags=("metrics", "ros", "complexity"),
        tool="judge",
        fingerprint=fingerprint("ros.cyclomatic_complexity.max", "function:a.cpp#Foo::bar()"),
        quantity=CC,
        value=23.0,
        bound=15,
        model="ros",
        breach="cyclomatic complexity 23 (limit 15, 1.5 x)",
        consequence=Consequence.HARD_TO_MAINTAIN,
        certainty=Certainty.PROVEN,
    )
    assert finding.rule in {rule.id for rule in rules_of(ROS)}


@pytest.mark.parametrize(
    ("value", "rules"),
    [
        (10, []),
        (10.5, ["his.cyclomatic_complexity.max"]),
        (15, ["his.cyclomatic_complexity.max"]),
        (15.0001, ["ros.cyclomatic_complexity.max", "his.cyclomatic_complexity.max"]),
        (math.nan, []),
        (-1, []),
    ],
)
def test_bounds_are_strict_and_each_model_has_its_own(value: float, rules: list[str]):
    assert [finding.rule for finding in judge_entities([ROS, HIS], [function({CC: value})])] == rules


def test_a_file_is_named_by_its_path():
    file = Entity("file:src/a.cpp", EntityKind.FILE, "a.cpp", "src/a.cpp", values={"comment_ratio": 12.0})
    (low,) = judge_entities([ROS], [file])
    assert low.message == "comment ratio 12 % (at least 20 %) of src/a.cpp"
    assert (low.rule, low.bound, low.line) == ("ros.comment_ratio.min", 20, 0)
    high = Entity("file:src/a.cpp", EntityKind.FILE, "a.cpp", "src/a.cpp", values={"comment_ratio": 41.0})
    assert [finding.rule for finding in judge_entities([ROS], [high])] == ["ros.comment_ratio.max"]


def test_only_entities_of_the_kind_and_name_are_judged():
    deep = {"nesting": 9.0}
    found = judge_entities([HIS], [function(deep, "n::f"), function(deep, "m::f"), function(deep, "n::sub::g")])
    assert [finding.entity for finding in found] == ["function:a.cpp#n::f()", "function:a.cpp#n::sub::g()"]
    assert judge_entities([ROS], [Entity("class:a#C", EntityKind.CLASS, "C", values={CC: 99.0})]) == ()


def test_what_was_not_measured_breaks_nothing():
    assert judge_entities([ROS, HIS], [function({}), function({"loc": 1000.0})]) == ()
    assert judge_entities([], [function({CC: 99.0})]) == ()


def test_fingerprints_survive_a_move_and_tell_twins_apart():
    (here,) = judge_entities([ROS], [function({CC: 23.0}, line=10)])
    (there,) = judge_entities([ROS], [function({CC: 24.0}, line=900)])
    twin = Entity("function:a.cpp#Foo::bar()~2", EntityKind.FUNCTION, "Foo::bar", "a.cpp", 30, values={CC: 23.0})
    (other,) = judge_entities([ROS], [twin])
    assert here.fingerprint == there.fingerprint
    assert other.fingerprint != here.fingerprint


def test_ratings_for_the_report():
    assert rate_values([ROS, HIS], EntityKind.FUNCTION, {CC: 12.0, "nesting": 9.0}) == (
        Rated(CC, 12.0, Range(maximum=15), State.OK, "ros"),
        Rated(CC, 12.0, Range(maximum=10), State.HIGH, "his"),
    )
    named = rate_values([HIS], EntityKind.FUNCTION, {"nesting": 9.0}, name="n::f")
    assert named == (Rated("nesting", 9.0, Range(maximum=4), State.HIGH, "his"),)
    assert rate_values([HIS], EntityKind.FUNCTION, {"nesting": 9.0}, name="m::f") == ()
    (unknown,) = rate_values([ROS], EntityKind.FUNCTION, {CC: math.nan})
    assert unknown.rating is State.UNKNOWN


bounds = st.one_of(st.none(), st.integers(-20, 20).map(float))


@st.composite
def models(draw: st.DrawFn) -> QualityModel:
    constraints = []
    for number in range(draw(st.integers(0, 4))):
        low, high = draw(bounds), draw(bounds)
        if low is not None and high is not None and low > high:
            low, high = high, low
        quantity = draw(st.sampled_from(["a", "b"]))
        kind = draw(st.sampled_from([EntityKind.FUNCTION, EntityKind.CLASS]))
        name = draw(st.sampled_from(["*", "x*"]))
        constraints.append(Constraint(f"c{number}", kind, quantity, Range(low, high), name))
    return QualityModel(draw(st.sampled_from(["m", "n"])), constraints=tuple(constraints))


@st.composite
def entities(draw: st.DrawFn) -> Entity:
    kind = draw(st.sampled_from([EntityKind.FUNCTION, EntityKind.CLASS, EntityKind.FILE]))
    name = draw(st.sampled_from(["x1", "y1"]))
    values = draw(st.dictionaries(st.sampled_from(["a", "b", "c"]), st.one_of(st.integers(-30, 30), st.floats())))
    return Entity(f"{kind.value}:f#{name}", kind, name, values={key: float(value) for key, value in values.items()})


@given(st.lists(models(), max_size=3), st.lists(entities(), max_size=4))
def test_the_compiled_way_finds_what_the_plain_way_finds(some: list[QualityModel], things: list[Entity]):
    plain = sorted(
        (thing.id, model.name, one.id, rating.value)
        for thing in things
        for model in some
        for one in model.constraints
        if one.kind is thing.kind and one.quantity in thing.values and (one.name == "*" or thing.name.startswith("x"))
        if (rating := rate(thing.values[one.quantity], one.range)) in {State.LOW, State.HIGH}
    )
    word = {"max": "high", "min": "low"}
    found = judge_entities(some, things)
    assert plain == sorted(
        (finding.entity, finding.model, finding.rule.split(".")[1], word[finding.rule.split(".")[2]])
        for finding in found
    )
    assert found == judge_entities(some, things)
