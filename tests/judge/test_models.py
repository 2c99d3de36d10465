"""The built-in models: every number against a table typed from the published sources."""

from __future__ import annotations

import pytest

from roslens.judge.quality.constraint import Constraint
from roslens.judge.quality.quality_model import QualityModel, builtin_models, load_model, rules_of
from roslens.model.entity import EntityKind
from roslens.model.finding import Severity
from roslens.source.metrics.table import QUANTITIES
from roslens.source.tools.cccc_quantities import CCCC_QUANTITIES

KNOWN = {**QUANTITIES, **{quantity.key: quantity for quantity in CCCC_QUANTITIES}}

Bounds = tuple[float | None, float | None]

# The rows of the rule set of 2015 (its rules.yaml, with the tags of each model) and, for the last two, of HAROS 3.
TABLE: dict[str, dict[tuple[str, str], Bounds]] = {
    "ros": {
        ("file", "comment_ratio"): (20, None),
        ("function", "cyclomatic_complexity"): (None, 15),
        ("function", "eloc"): (None, 70),
        ("function", "calls"): (None, 10),
        ("function", "nesting"): (None, 5),
        ("function", "static_paths"): (None, 250),
        ("class", "cbo"): (None, 5),
        ("class", "noc"): (None, 10),
        ("class", "wmc"): (1, 100),
        ("class", "dit"): (None, 5),
        ("class", "mac"): (1, 20),
    },
    "nasa-satc": {
        ("file", "comment_ratio"): (20, 30),
        ("function", "cyclomatic_complexity"): (None, 10),
        ("function", "eloc"): (None, 50),
        ("class", "cbo"): (None, 5),
        ("class", "wmc"): (None, 100),
        ("class", "dit"): (None, 5),
        ("class", "mac"): (1, 20),
    },
    "his": {
        ("file", "comment_ratio"): (20, None),
        ("function", "cyclomatic_complexity"): (None, 10),
        ("function", "eloc"): (None, 50),
        ("function", "calls"): (None, 7),
        ("function", "nesting"): (None, 4),
        ("function", "static_paths"): (None, 80),
    },
    "kth": {
        ("function", "cyclomatic_complexity"): (None, 15),
        ("function", "eloc"): (None, 70),
        ("function", "calls"): (None, 10),
        ("function", "nesting"): (None, 5),
        ("function", "static_paths"): (None, 250),
    },
    "akureyri": {
        ("file", "comment_ratio"): (20, 40),
        ("class", "noc"): (None, 10),
        ("class", "wmc"): (1, 50),
        ("class", "dit"): (None, 5),
    },
    "hicpp": {
        ("function", "cyclomatic_complexity"): (None, 10),
        ("function", "static_paths"): (None, 200),
        ("function", "parameters"): (None, 6),
    },
    "verifysoft": {
        ("function", "loc"): (None, 40),
        ("file", "loc"): (None, 400),
        ("file", "maintainability_index"): (65, None),
        ("file", "halstead_volume"): (None, 8000),
        ("file", "halstead_bugs"): (None, 2),
    },
    "microsoft": {
        ("file", "maintainability_index"): (20, None),
    },
    "paper2016": {
        ("file", "paper2016.comment_ratio"): (20, None),
        ("function", "paper2016.cyclomatic_complexity"): (None, 15),
        ("class", "paper2016.cbo"): (None, 5),
        ("class", "paper2016.noc"): (None, 10),
        ("class", "paper2016.wmc"): (None, 100),
        ("class", "paper2016.dit"): (None, 5),
        ("class", "paper2016.mac"): (None, 20),
    },
}


@pytest.fixture(scope="module")
def models() -> dict[str, QualityModel]:
    return {name: load_model(name, KNOWN) for name in builtin_models()}


def every_constraint(models: dict[str, QualityModel]) -> list[Constraint]:
    return [one for model in models.values() for one in model.constraints]


def test_the_models_there_are():
    # Those of the field are measured, not published: tests/judge/test_field.py.
    assert set(builtin_models()) == {*TABLE, "ros-2026", "extreme"}


@pytest.mark.parametrize("name", sorted(TABLE))
def test_thresholds_are_the_published_ones(models: dict[str, QualityModel], name: str):
    found: dict[tuple[str, str], tuple[float | None, float | None]] = {}
    for one in models[name].constraints:
        # The two sides of a range may be two constraints, where one matters less.
        low, high = found.get((one.kind.value, one.quantity), (None, None))
        assert None in (low, one.range.minimum)
        assert None in (high, one.range.maximum)
        found[one.kind.value, one.quantity] = (
            one.range.minimum if low is None else low,
            one.range.maximum if high is None else high,
        )
    assert found == TABLE[name]


def test_every_model_is_called_as_its_file_and_says_what_it_is(models: dict[str, QualityModel]):
    for name, model in models.items():
        assert model.name == name
        assert model.title
        assert len(model.text) > 40
        assert len(model.source) > 20


def test_every_constraint_says_where_it_is_from_and_why(models: dict[str, QualityModel]):
    for one in every_constraint(models):
        assert one.source, one
        assert len(one.rationale) > 30, one
        assert one.tags, one
        assert one.name == "*"


def test_what_most_of_the_field_breaks_and_what_is_often_wanted_is_a_note(models: dict[str, QualityModel]):
    notes = {
        (model.name, one.quantity, side)
        for model in models.values()
        for one in model.constraints
        for side in one.sides
        if one.severity is Severity.NOTE
    }
    assert notes == {("ros", "calls", "max"), ("ros", "wmc", "min"), ("ros", "mac", "min")}


def test_the_thirteen_rules_of_the_ros_model(models: dict[str, QualityModel]):
    assert [rule.id for rule in rules_of(models["ros"])] == [
        "ros.comment_ratio.min",
        "ros.cyclomatic_complexity.max",
        "ros.eloc.max",
        "ros.calls.max",
        "ros.nesting.max",
        "ros.static_paths.max",
        "ros.cbo.max",
        "ros.noc.max",
        "ros.wmc.max",
        "ros.wmc.min",
        "ros.dit.max",
        "ros.mac.max",
        "ros.mac.min",
        "ros.function_limits",
        "ros.class_limits",
    ]


def test_rules_are_told_apart_over_all_models(models: dict[str, QualityModel]):
    rules = [rule for model in models.values() for rule in rules_of(model)]
    assert len({rule.id for rule in rules}) == len(rules)
    for rule in rules:
        assert rule.title
        assert "  " not in rule.description
        assert rule.description.endswith(".")
        assert rule.tags[0] == "metrics"


def test_only_the_ros_model_is_tagged_so(models: dict[str, QualityModel]):
    tagged = {name for name, model in models.items() for rule in rules_of(model) if "ros" in rule.tags}
    assert tagged == {"ros"}


def test_constraints_are_on_entities_that_have_the_value(models: dict[str, QualityModel]):
    for one in every_constraint(models):
        assert one.kind in KNOWN[one.quantity].kinds
        assert one.kind in {EntityKind.FILE, EntityKind.CLASS, EntityKind.FUNCTION}
