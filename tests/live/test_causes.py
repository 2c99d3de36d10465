"""The first fault upstream explains the others."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from roslens.live.causes import first_causes
from roslens.model.entity import EntityId, EntityKind


def node(name):
    return EntityId(EntityKind.NODE, name)


def topic(name):
    return EntityId(EntityKind.TOPIC, name)


def causes(bad, links, fine=()):
    return first_causes(bad, lambda one: one in fine, lambda one: links.get(one, ()))


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


@given(
    st.dictionaries(st.integers(0, 9), st.lists(st.integers(0, 9), max_size=4)),
    st.dictionaries(st.integers(0, 9), st.floats(0, 100)),
)
def test_a_cause_is_bad_itself_and_has_no_cause(links, bad):
    names = {node(str(key)): [node(str(one)) for one in ends] for key, ends in links.items()}
    found = causes({node(str(key)): since for key, since in bad.items()}, names)
    for entity, cause in found.items():
        assert cause != entity
        assert int(cause.name) in bad
        assert cause not in found


def test_ten_thousand_nodes_in_a_row_are_no_trouble():
    links = {node(f"{n:05}"): [node(f"{n + 1:05}")] for n in range(10_000)}
    found = causes({node(f"{n:05}"): 5.0 for n in range(10_000)}, links)
    assert found[node("00000")] == node("09999")
