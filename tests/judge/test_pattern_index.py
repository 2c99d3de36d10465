"""Finding the sentences about an entity: as many as asking each, in the order given, in no time."""

from __future__ import annotations

import time

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pace import turned_s

from roslens.judge.reference.expectation import Selector
from roslens.judge.reference.pattern_index import CompiledSelector, PatternIndex
from roslens.model.entity import EntityKind

TOPIC, NODE, CONNECTION = EntityKind.TOPIC, EntityKind.NODE, EntityKind.CONNECTION


def test_every_part_of_a_selector_has_to_hold():
    index = PatternIndex(
        [
            (Selector(CONNECTION, "/scan"), "all"),
            (Selector(CONNECTION, "/scan", publisher="/lidar"), "from lidar"),
            (Selector(CONNECTION, "/scan", subscriber="/amcl", host="robot*"), "to amcl"),
            (Selector(CONNECTION, "/**", type="sensor_msgs/**"), "typed"),
            (Selector(CONNECTION, "**", without=("/sc*", "/tf")), "without"),
            (Selector(TOPIC, "/scan"), "topic"),
        ]
    )
    assert index.find(CONNECTION, "/scan", publisher="/lidar", subscriber="/amcl") == ("all", "from lidar")
    assert index.find(CONNECTION, "/scan", host="robot-1", subscriber="/amcl", type="sensor_msgs/msg/LaserScan") == (
        "all",
        "to amcl",
        "typed",
    )
    assert index.find(CONNECTION, "/odom") == ("without",)
    assert index.find(CONNECTION, "/tf") == ()
    assert index.find(NODE, "/scan") == ()


def test_a_wrong_pattern_is_refused():
    with pytest.raises(ValueError, match="without"):
        PatternIndex([(Selector(TOPIC, "/{a"), 1)])


PART = st.sampled_from(["/a", "/b", "/*", "/**", "/a*", "/*b", "", "a", "//", "/?"])
NAMES = st.sampled_from(["", "/", "/a", "/b", "/a/b", "/b/a/b", "/ab", "a", "a/b", "//a", "/a/b/a"])


@given(st.lists(st.lists(PART, min_size=1, max_size=3).map("".join).filter(bool), max_size=12), NAMES)
def test_the_index_finds_what_asking_each_finds(patterns: list[str], name: str):
    patterns = [pattern for pattern in patterns if "***" not in pattern]
    selectors = [Selector(TOPIC, pattern) for pattern in patterns]
    index = PatternIndex((selector, number) for number, selector in enumerate(selectors))
    asked = [n for n, selector in enumerate(selectors) if CompiledSelector(selector).matches(name, ("", "", "", ""))]
    assert list(index.find(TOPIC, name)) == asked


@pytest.mark.timed
def test_a_new_entity_costs_far_less_than_a_millisecond_among_a_thousand_sentences():
    selectors = [Selector(TOPIC, f"/robot{n}/*/state") for n in range(500)]
    selectors += [Selector(TOPIC, f"/**/sensor{n}*") for n in range(250)]
    selectors += [Selector(TOPIC, f"/*/joint{n}") for n in range(250)]
    index = PatternIndex((selector, number) for number, selector in enumerate(selectors))
    names = [f"/robot{n % 500}/arm{n}/state" for n in range(1000)]
    took = []
    for _ in range(3):
        started = time.process_time()
        found = [index.find(TOPIC, name) for name in names]
        took.append(turned_s(started) / len(names))
    assert found[7] == (7,)
    assert min(took) < 0.0005
