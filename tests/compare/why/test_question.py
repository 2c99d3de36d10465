import pytest

from roslens.compare.why.question import Question, near_names, question_of
from roslens.model.errors import UsageError

KNOWN = {"topic": {"/scan", "/front/scan", "/odom"}, "node": {"/scan", "/planner"}, "service": {"/reset"}}


@pytest.mark.parametrize(
    ("word", "meant"),
    [
        ("/odom", Question("topic", "/odom")),
        ("odom", Question("topic", "/odom")),
        ("planner", Question("node", "/planner")),
        ("/scan", Question("topic", "/scan")),
        ("node:/scan", Question("node", "/scan")),
        ("service:reset", Question("service", "/reset")),
        ("map->base_link", Question("transform", "map->base_link")),
        (" map -> base_link ", Question("transform", "map->base_link")),
        ("/map->/base_link", Question("transform", "map->base_link")),
        ("frame:laser", Question("frame", "laser")),
        ("transform:map->base_link", Question("transform", "map->base_link")),
    ],
)
def test_a_word_is_the_first_kind_that_has_it(word, meant):
    assert question_of(word, KNOWN) == meant


def test_an_unknown_name_has_the_nearest_ones():
    with pytest.raises(UsageError) as raised:
        question_of("/scann", KNOWN)
    assert 'called "/scann"; expected one of 3 topics, 1 services, 2 nodes' in str(raised.value)
    assert "Did you mean /scan (topic)" in str(raised.value)
    with pytest.raises(UsageError, match=r"expected one of 2 nodes$"):
        question_of("node:/odometry", {"node": {"/a", "/b"}})


@pytest.mark.parametrize("word", ["->", "map->", "->base", "transform:->x", "frame:", "frame:/"])
def test_a_transform_has_two_frames(word):
    with pytest.raises(UsageError, match="or two as in"):
        question_of(word, KNOWN)


def test_nothing_to_look_at_says_what_is_needed():
    with pytest.raises(UsageError, match="a workspace, a recording or a running system"):
        question_of("/scan", {})


def test_the_same_end_in_another_namespace_is_nearest():
    assert near_names("/robot/scan", ["/scann", "/front/scan", "/odom"])[0] == "/front/scan"
