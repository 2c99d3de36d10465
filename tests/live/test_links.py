"""The way from a fault to its first cause, with what shows each link."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from live.time_line import Played, read

from roslens.live.explain.links import MOST_VISITED, links, links_text
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import Link

LINES = Path(__file__).parent / "time_lines"


def node(name: str) -> EntityId:
    return EntityId(EntityKind.NODE, name)


def topic(name: str) -> EntityId:
    return EntityId(EntityKind.TOPIC, name)


def test_the_shortest_way_is_told_with_what_is_wrong_on_it():
    upstream = {
        topic("/plan"): [node("/planner")],
        node("/planner"): [topic("/map"), topic("/scan")],
        topic("/map"): [node("/slam")],
        node("/slam"): [topic("/scan")],
        topic("/scan"): [node("/lidar")],
    }
    wrong = {topic("/scan"): "rate absent", node("/lidar"): "gone for 2.0 s"}
    of_plan = {topic("/plan"): node("/lidar")}
    way = links(of_plan, lambda one: upstream.get(one, ()), lambda _, after: wrong.get(after, ""))[topic("/plan")]
    assert way == (
        Link("node:/planner", "is published by"),
        Link("topic:/scan", "subscribes to", "rate absent"),
        Link("node:/lidar", "is published by", "gone for 2.0 s"),
    )
    assert links_text(topic("/plan"), way) == (
        "topic:/plan is published by node:/planner, which subscribes to topic:/scan (rate absent), "
        "which is published by node:/lidar (gone for 2.0 s)"
    )


def test_a_graph_without_end_gives_both_ends_alone():
    found = links({node("/0"): node("/x")}, lambda one: [node(f"/{int(one.name[1:]) + 1}")], lambda *_: "gone")
    assert found == {node("/0"): (Link("node:/x", "is explained by", "gone"),)}
    assert MOST_VISITED < 100_000


@given(st.dictionaries(st.integers(0, 7), st.lists(st.integers(0, 7)), max_size=8), st.data())
def test_each_way_is_the_first_of_the_shortest(numbers, data):
    upstream = {node(str(one)): [node(str(other)) for other in others] for one, others in numbers.items()}
    every = sorted({*upstream, *(one for others in upstream.values() for one in others)}) or [node("0")]
    causes = data.draw(st.dictionaries(st.sampled_from(every), st.sampled_from(every)))
    causes = {fault: cause for fault, cause in causes.items() if fault != cause}
    for fault, way in links(causes, lambda one: upstream.get(one, ()), lambda *_: "").items():
        ways = [(fault,)]
        for _ in every:
            ways = [(*one, step) for one in ways for step in sorted(set(upstream.get(one[-1], ())))]
            if reached := [one for one in ways if one[-1] == causes[fault]]:
                assert [one.entity for one in way] == [str(step) for step in min(reached)[1:]]
                break
        else:
            assert [one.relation for one in way] == ["is explained by"]


def test_when_everything_breaks_at_once_each_entity_is_looked_at_once():
    """1,500 topics in a circle of nodes, all explained by the first of them."""
    asked, shown = Counter(), Counter()

    def upstream(one):
        asked[one] += 1
        number = int(one.name[2:])
        if one.kind is EntityKind.TOPIC:
            return [node(f"/n{number % 150}")]
        return [topic(f"/t{(number * 7 + place * 31) % 1500}") for place in range(20)]

    def evidence(before, after):
        shown[before, after] += 1
        return "late"

    faults = [topic(f"/t{number}") for number in range(1, 1500)]
    found = links(dict.fromkeys(faults, topic("/t0")), upstream, evidence)
    assert found.keys() == set(faults)
    assert max(asked.values()) == 1
    assert max(shown.values()) == 1


@pytest.mark.parametrize(
    ("line", "of", "said"),
    [
        ("host_busy", ("topic:/map", "map"), "host:r1 (cpu 99 is high, and /slam waits for a processor 60 % of"),
        ("host_busy", ("topic:/scan", "scan"), "topic:/scan is published by node:/lidar (is gone)"),
        ("host_busy", ("topic:/plan", "plan"), "which subscribes to topic:/scan (rate "),
        ("host_reasons", ("topic:/a", "a"), "host:starved (pressure_cpu 90 is high: what runs there waits)"),
        ("host_reasons", ("topic:/c", "c"), "host:lossy (resent 20 is high: its link loses messages)"),
        ("host_reasons", ("topic:/e", "late"), "host:wrong (clock_offset 0.3 is high: its clock is wrong)"),
        ("frozen_node", ("topic:/scan", "scan"), "node:/lidar (is stopped)"),
    ],
)  # fmt: skip
def test_verdicts_say_why_their_cause_is_one(line, of, said):
    verdict = Played(read(LINES / f"{line}.yaml")).at(25)[of]
    assert said in links_text(verdict.entity, verdict.why)
    assert verdict.why[-1].entity == verdict.cause
