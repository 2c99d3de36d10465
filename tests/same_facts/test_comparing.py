"""Differences of documents are found wherever they are, and named by entity and field."""

import copy

import pytest

from same_facts.comparing import NOTHING, Difference, differences

DOCUMENT = {
    "packages": [
        {
            "title": "all packages of ROS 2",
            "nodes": [
                {"name": "/talker", "endpoints": [{"endpoint": {"name": "/chatter"}, "queue": 10, "given": "chatter"}]},
                {"name": "/listener", "endpoints": [], "resolved": True},
            ],
        }
    ],
    "findings": {"all": [{"fingerprint": "ab12", "line": 3}]},
    "lists": [1, 2, 3],
}


def changed(change):
    document = copy.deepcopy(DOCUMENT)
    change(document)
    return list(differences(DOCUMENT, document))


def test_the_same_has_no_difference():
    assert changed(lambda document: None) == []


def test_a_changed_field_is_named_with_its_entity():
    def change(document):
        document["packages"][0]["nodes"][0]["endpoints"][0]["queue"] = 5

    on_the_way = "packages > all packages of ROS 2 > nodes > /talker > endpoints > /chatter"
    assert changed(change) == [Difference(on_the_way, "queue", "10", "5")]


def test_what_is_gone_is_one_difference_and_its_neighbours_none():
    (one,) = changed(lambda document: document["packages"][0]["nodes"].pop(0))
    assert (one.field, one.after) == ("/talker", NOTHING)


def test_what_is_new_is_one_difference():
    (one,) = changed(lambda document: document["packages"][0]["nodes"].insert(0, {"name": "/more"}))
    assert (one.field, one.before, one.after) == ("/more", NOTHING, '{"name":"/more"}')


def test_another_order_is_a_difference():
    (one,) = changed(lambda document: document["packages"][0]["nodes"].reverse())
    assert (one.field, one.before) == ("order", '["/talker","/listener"]')


def test_one_of_two_with_the_same_name_is_told():
    twice = [{"name": "/a", "queue": 1}, {"name": "/a", "queue": 2}]
    (one,) = differences(twice, [twice[0], {"name": "/a", "queue": 3}])
    assert one == Difference("/a #2", "queue", "2", "3")


def test_findings_are_named_by_their_fingerprint():
    (one,) = changed(lambda document: document["findings"]["all"][0].update(line=4))
    assert one == Difference("findings > all > ab12", "line", "3", "4")


@pytest.mark.parametrize(("before", "after"), [(1, 2), (1, 1.0), (0, False), (None, ""), ([], [1]), ({}, [])])
def test_values_differ_by_type_too(before, after):
    (one,) = differences({"x": before}, {"x": after})
    assert one.field == "x"
