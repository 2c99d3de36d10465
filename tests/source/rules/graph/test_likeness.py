import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.rules.graph.likeness import alike, distance, nearest_name

WORDS = st.text("ab/_", max_size=7)


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        ("", "", 0),
        ("scan", "scan", 0),
        ("scan", "scn", 1),
        ("scan", "sacn", 1),
        ("raw", "row", 1),
        ("ab", "ba", 1),
        ("abc", "xyz", 3),
    ],
)
def test_distances_that_are_known(one, other, expected):
    assert distance(one, other) == expected


@given(WORDS, WORDS)
def test_it_does_not_matter_which_comes_first(one, other):
    assert distance(one, other, 9) == distance(other, one, 9)


@given(WORDS, WORDS)
def test_a_bound_only_cuts(one, other):
    assert distance(one, other, 2) == min(distance(one, other, 9), 3)


def test_short_names_are_not_alike():
    assert not alike("/a", "/b")
    assert not alike("/scan", "/scan")
    assert alike("/scan", "/scna")


def test_the_nearest_is_the_one_with_the_fewest_mistakes():
    assert nearest_name("cmd_vle", ["cmd_vel", "cmd_val", "scan"]) == "cmd_vel"
    assert nearest_name("cmd_vel", ["joint_states"]) == ""
