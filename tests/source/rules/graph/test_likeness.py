import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.rules.graph.likeness import alike, distance, likely_program, nearest_name

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


def test_the_program_that_was_likely_meant():
    valid = ["talker", "graph_search_server_node.py", "graph_search_client_node.py", "video_save", "sdc_V2"]
    assert likely_program("talkr", valid) == "talker"
    assert likely_program("graph_search_server.py", valid) == "graph_search_server_node.py"
    assert likely_program("GraphSearchClientNode", valid) == "graph_search_client_node.py"
    assert likely_program("save_video", valid) == ""
    assert likely_program("video", valid) == "video_save"
    assert likely_program("node", valid) == ""
