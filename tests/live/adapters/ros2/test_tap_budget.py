from hypothesis import given
from hypothesis import strategies as st

from roslens.live.adapters.ros2.tap import matcher, within


def test_all_that_fit_are_chosen():
    assert within({"/a": 0.01, "/b": 0.02, "/c": 0.0}, 0.1, 0) == ["/a", "/b", "/c"]


def test_those_that_do_not_fit_come_in_turn():
    costs = {"/a": 0.06, "/b": 0.06, "/c": 0.06}
    assert within(costs, 0.1, 0) == ["/a"]
    assert within(costs, 0.1, 1) == ["/b"]
    assert within(costs, 0.1, 5) == ["/c"]


def test_one_that_is_too_dear_alone_waits_until_the_debt_is_paid():
    assert within({"/a": 0.5}, 0.1, 0) == ["/a"]
    assert within({"/a": 0.5}, -0.4, 0) == []
    assert within({}, 0.1, 3) == []


@given(st.dictionaries(st.text(min_size=1), st.floats(0.001, 1), min_size=1), st.floats(0, 2))
def test_every_topic_gets_its_turn(costs, credit):
    seen, first = set(), 0
    for _ in range(2 * len(costs)):
        chosen = within(costs, credit, first)
        seen |= set(chosen)
        first += max(1, len(chosen))
    assert seen == set(costs)


def test_stars_stay_within_a_part_of_the_name_and_double_stars_do_not():
    assert matcher("/demo/*")("/demo/chatter")
    assert not matcher("/demo/*")("/demo/a/b")
    assert matcher("/**")("/demo/a/b")
    assert matcher("/a?.[x]")("/ab.[x]")
    assert not matcher("/a?.[x]")("/a/.[x]")
