"""The tables of what distributions deprecated and removed, and what a row means for a target."""

import pytest

from roslens.source.distributions.known_distributions import distributions, is_at_least
from roslens.source.distributions.read_changes import Change, Effect, Kind, changes_of, effect_of, read_changes
from roslens.source.distributions.target import Target

ROW = Change(kind=Kind.HEADER, name="a/a.h", deprecated="iron", removed="jazzy", instead="a/a.hpp")


@pytest.mark.parametrize("change", read_changes().values(), ids=lambda one: one.key)
def test_each_row_says_when_and_by_whom(change):
    assert change.source, "a row names its source"
    assert change.first, "a row names the distribution that deprecates or removes"
    assert {distributions()[one].ros for one in (change.deprecated, change.removed, change.since) if one} == {
        change.ros
    }
    if change.deprecated and change.removed:
        assert is_at_least(change.removed, change.deprecated)
    if change.alike:
        assert change.instead


def test_what_takes_the_place_is_there():
    for change in read_changes().values():
        for other in changes_of(change.kind).get(change.instead, ()):
            same = other.ros == change.ros and other.removed and change.removed
            assert not same or is_at_least(other.removed, change.removed), change.key
            assert not same or other.removed != change.removed, change.key


@pytest.mark.parametrize(
    ("distros", "effect"),
    [
        (("humble",), Effect.NONE),
        (("iron",), Effect.DEPRECATED),
        (("jazzy",), Effect.REMOVED),
        (("rolling",), Effect.REMOVED),
        (("humble", "jazzy"), Effect.REMOVED),
        (("noetic",), Effect.LATER),
        ((), Effect.LATER),
    ],
)
def test_what_a_row_means_for_a_target(distros, effect):
    assert effect_of(ROW, Target(distros)) is effect


def test_what_no_supported_distribution_has_is_gone_also_where_no_target_is_known():
    old = Change(kind=Kind.CPP, name="a::b", deprecated="foxy", removed="galactic")
    assert effect_of(old, Target()) is Effect.REMOVED
    assert effect_of(old, Target(earlier=("foxy",))) is Effect.LATER, "its last commit is of when Foxy was supported"
    assert effect_of(old, Target(earlier=("melodic",))) is Effect.REMOVED


def test_what_people_are_told_may_be_older_than_the_code():
    change = next(
        one for one in read_changes().values() if one.ros == 2 and one.removed == "jazzy" and not one.deprecated
    )
    assert effect_of(change, Target(("foxy",))) is Effect.NONE
    assert effect_of(change, Target(("foxy",), told=True)) is Effect.LATER
    assert effect_of(change, Target(("jazzy",), told=True)) is Effect.REMOVED
    assert effect_of(change, Target(("humble", "jazzy"), told=True)) is Effect.LATER
    assert effect_of(change, Target(("humble", "jazzy"))) is Effect.REMOVED


def test_a_name_may_have_a_row_for_each_version_of_ros():
    assert {one.ros for one in changes_of(Kind.HEADER)["pluginlib/class_list_macros.h"]} == {1, 2}
