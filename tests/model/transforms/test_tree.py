import pytest

from roslens.model.transforms.transform import Transform
from roslens.model.transforms.tree import tree_of

SECOND = 10**9


def said(parent, child, at=1.0, stamp=None, **more):
    received = round(at * SECOND)
    return Transform(parent, child, received if stamp is None else round(stamp * SECOND), received=received, **more)


TREE = [said("map", "odom"), said("odom", "base"), said("base", "laser", static=True), said("base", "arm")]


def test_the_way_between_two_frames_goes_over_their_nearest_common_one():
    tree = tree_of(TREE)
    assert tree.way("map", "laser") == ("laser", "base", "odom", "map")
    assert tree.way("arm", "laser") == ("laser", "base", "arm")
    assert tree.way("laser", "laser") == ("laser",)
    assert [one.child for one in tree.between("arm", "laser")] == ["laser", "arm"]
    assert [one.child for one in tree.between("map", "base")] == ["base", "odom"]
    assert (tree.root("laser"), tree.trees()) == ("map", {"map": 5})


def test_two_trees_have_no_way():
    tree = tree_of([*TREE, said("world", "crane")])
    assert tree.way("map", "crane") == ()
    assert tree.between("map", "crane") == ()
    assert tree.trees() == {"map": 5, "world": 2}


def test_a_loop_is_told_and_ends():
    tree = tree_of([said("a", "b"), said("b", "c"), said("c", "a"), said("c", "d")])
    assert set(tree.loop("d")) == {"a", "b", "c"}
    assert tree.loop("b")
    assert tree_of(TREE).loop("laser") == ()


def test_parents_are_counted_and_the_newest_is_last():
    line = tree_of([said("a", "x"), said("b", "x"), said("a", "x")]).lines["x"]
    assert (line.parents, line.parent) == ((("b", 1), ("a", 2)), "a")


def test_ages_and_stamps_in_the_future():
    line = tree_of([said("a", "x", at, at - 0.2) for at in range(1, 9)]).lines["x"]
    assert line.age == line.oldest == pytest.approx(0.2)
    assert (line.ahead, line.back) == (0.0, 0)
    assert tree_of([said("a", "x", 1, 1.05)]).lines["x"].ahead == 0.0
    assert tree_of([said("a", "x", 1, 1.5)]).lines["x"].ahead == pytest.approx(0.5)


def test_stamps_of_a_simulation_are_of_another_clock_and_not_in_the_future():
    assert tree_of([said("a", "x", 1e9, 12)]).lines["x"].is_of_another_clock
    line = tree_of([said("a", "x", 12, 1e9)]).lines["x"]
    assert (line.is_of_another_clock, line.ahead) == (True, 0.0)


def test_stamps_that_go_back_are_counted():
    assert tree_of([said("a", "x", 1, 5), said("a", "x", 2, 4), said("a", "x", 3, 6)]).lines["x"].back == 1


def test_what_tf2_ignores_is_a_flaw_and_no_transform():
    flawed = [
        said("x", "x"), said("", "x"), said("a", "x", translation=(float("nan"), 0.0, 0.0)),
        said("a", "x", rotation=(0.0, 0.0, 0.0, 0.0)),
    ]  # fmt: skip
    line = tree_of(flawed).lines["x"]
    assert (line.received, line.parent) == ((), "")
    assert [words for words, _ in line.flaws] == [
        '"x" in "a" has a rotation whose length is not 1', '"x" in "a" has a value that is no number',
        '"x" is its own parent', "its parent has no name",
    ]  # fmt: skip
    assert tree_of([said("a", "")]).lines == {}


def test_nothing_is_an_empty_tree():
    assert tree_of([]).trees() == {}
