from __future__ import annotations

import pytest

from roslens.source.metrics.class_model.class_names import ClassNames

CPP = ClassNames(["Arm", "a::Arm", "a::Arm::Link", "a::b::Tool", "c::Tool", "c::d::Wheel", "Arming"], "::")


@pytest.mark.parametrize(
    ("name", "scope", "full_name"),
    [
        ("Arm", "", "Arm"),
        ("Arm", "x::y", "Arm"),
        ("Arm", "a", "a::Arm"),
        ("Arm", "a::b::Tool", "a::Arm"),
        ("a::Arm", "", "a::Arm"),
        ("Arm::Link", "a::b", "a::Arm::Link"),
        ("Link", "a::Arm", "a::Arm::Link"),
        ("b::Tool", "a", "a::b::Tool"),
        ("Tool", "c::d::Wheel", "c::Tool"),
    ],
)
def test_the_innermost_scope_that_has_the_name_wins(name, scope, full_name):
    assert CPP.find(name, scope) == full_name


def test_a_name_from_elsewhere_is_the_only_class_that_ends_with_it():
    assert CPP.find("Wheel", "a") == "c::d::Wheel"
    assert CPP.find("d::Wheel", "") == "c::d::Wheel"


def test_a_name_that_several_could_mean_stays_unknown():
    assert CPP.find("Tool", "") is None


@pytest.mark.parametrize("name", ["rm", "Ar", "x::Arm", "", "::", "x::Wheel"])
def test_other_names_mean_nothing(name):
    assert CPP.find(name, "") is None


def test_modules_are_scopes_of_python():
    names = ClassNames(["nav.costmap.Layer", "nav.planner.Layer", "nav.costmap.Grid"], ".")
    assert names.find("Layer", "nav.costmap.Grid") == "nav.costmap.Layer"
    assert names.find("planner.Layer", "nav.costmap.Grid") == "nav.planner.Layer"
    assert names.find("Grid", "nav.planner") == "nav.costmap.Grid"
    assert names.find("Layer", "other") is None
