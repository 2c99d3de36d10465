"""The first fault upstream explains the others."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.live.explain.causes import first_causes
from roslens.model.entity import EntityId, EntityKind


def node(name):
    return EntityId(EntityKind.NODE, name)


def topic(name):
    return EntityId(EntityKind.TOPIC, name)


def causes(bad, links, fine=(), weights=None, until=None):
    return first_causes(bad, lambda one: one in fine, lambda one: links.get(one, ()), weights, until)


def test_a_chain_has_one_cause_through_nodes_nobody_judges():
    links = {topic("b"): [node("n")], node("n"): [topic("a")], topic("a"): [node("m")]}
    found = causes({topic("b"): 10.4, topic("a"): 10.2, node("m"): 10.0}, links)
    assert found == {topic("b"): node("m"), topic("a"): node("m")}


def test_a_fine_topic_between_ends_the_search():
    links = {topic("b"): [node("n")], node("n"): [topic("a")], topic("a"): [node("m")]}
    assert causes({topic("b"): 10.4, node("m"): 10.0}, links, fine={topic("a")}) == {}


def test_what_was_bad_long_before_is_no_consequence():
    links = {topic("a"): [node("m")]}
    assert causes({topic("a"): 1.0, node("m"): 10.0}, links) == {}


def test_in_a_cycle_the_first_to_fail_is_the_cause():
    links = {topic("a"): [node("n")], node("n"): [topic("b")], topic("b"): [node("m")], node("m"): [topic("a")]}
    assert causes({topic("a"): 3.0, topic("b"): 2.0}, links) == {topic("a"): topic("b")}


def test_an_error_is_not_explained_by_a_warning():
    links = {topic("b"): [topic("a")], topic("a"): [node("m")]}
    bad = {topic("b"): 5.0, topic("a"): 5.0, node("m"): 1.0}
    assert causes(bad, links, weights={topic("b"): 1, topic("a"): 2, node("m"): 1}) == {topic("b"): topic("a")}
    assert causes(bad, links, weights={topic("b"): 1, topic("a"): 1, node("m"): 2}) == {
        topic("b"): node("m"),
        topic("a"): node("m"),
    }


def test_an_error_behind_a_warning_explains_an_error():
    links = {topic("b"): [topic("a")], topic("a"): [node("m")]}
    weights = {topic("b"): 2, topic("a"): 1, node("m"): 2}
    assert causes({topic("b"): 5.0, topic("a"): 1.0, node("m"): 3.5}, links, weights=weights) == {topic("b"): node("m")}


def test_of_two_explanations_the_graver_one_wins_however_late():
    links = {topic("a"): [node("m"), node("n")]}
    bad = {topic("a"): 5.0, node("m"): 1.0, node("n"): 4.0}
    assert causes(bad, links, weights={node("n"): 2}) == {topic("a"): node("n")}
    assert causes(bad, links) == {topic("a"): node("m")}


def test_what_explains_for_a_while_explains_nothing_later():
    links = {topic("a"): [node("m")]}
    assert causes({topic("a"): 50.0, node("m"): 1.0}, links, until={node("m"): 49.0}) == {}
    assert causes({topic("a"): 48.0, node("m"): 1.0}, links, until={node("m"): 49.0}) == {topic("a"): node("m")}


@given(
    st.dictionaries(st.integers(0, 9), st.lists(st.integers(0, 9), max_size=4)),
    st.dictionaries(st.integers(0, 9), st.floats(0, 100)),
    st.dictionaries(st.integers(0, 9), st.integers(0, 3)),
)
def test_a_cause_is_bad_itself_matters_as_much_and_has_no_cause(links, bad, weights):
    names = {node(str(key)): [node(str(one)) for one in ends] for key, ends in links.items()}
    weighed = {node(str(key)): weight for key, weight in weights.items()}
    found = causes({node(str(key)): since for key, since in bad.items()}, names, weights=weighed)
    for entity, cause in found.items():
        assert weighed.get(cause, 0) >= weighed.get(entity, 0)
        assert cause != entity
        assert int(cause.name) in bad
        assert cause not in found


def test_ten_thousand_nodes_in_a_row_are_no_trouble():
    links = {node(f"{n:05}"): [node(f"{n + 1:05}")] for n in range(10_000)}
    found = causes({node(f"{n:05}"): 5.0 for n in range(10_000)}, links)
    assert found[node("00000")] == node("09999")
