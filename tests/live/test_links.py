"""The way from a fault to its first cause, with what shows each link."""

from __future__ import annotations

from pathlib import Path

import pytest
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
    way = links(
        topic("/plan"), node("/lidar"), lambda one: upstream.get(one, ()), lambda _, after: wrong.get(after, "")
    )
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
    way = links(node("/0"), node("/x"), lambda one: [node(f"/{int(one.name[1:]) + 1}")], lambda *_: "gone")
    assert way == (Link("node:/x", "is explained by", "gone"),)
    assert MOST_VISITED < 10_000


@pytest.mark.parametrize(
    ("line", "of", "said"),
    [
        ("host_busy", ("topic:/map", "map"), "host:r1 (cpu 99 is high, and /slam waits for a processor 60 % of"),
        ("host_busy", ("topic:/scan", "scan"), "topic:/scan is published by node:/lidar (is gone)"),
        ("host_busy", ("topic:/plan", "plan"), "which subscribes to topic:/scan (rate "),
        ("host_reasons", ("topic:/a", "a"), "host:starved (pressure_cpu 90 is high: what runs there waits)"),
        ("host_reasons", ("topic:/c", "c"), "host:lossy (resent 20 is high: its line loses what is sent)"),
        ("host_reasons", ("topic:/e", "late"), "host:wrong (clock_offset 0.3 is high: its clock is wrong)"),
        ("frozen_node", ("topic:/scan", "scan"), "node:/lidar (is stopped)"),
    ],
)  # fmt: skip
def test_verdicts_say_why_their_cause_is_one(line, of, said):
    verdict = Played(read(LINES / f"{line}.yaml")).at(25)[of]
    assert said in links_text(verdict.entity, verdict.why)
    assert verdict.why[-1].entity == verdict.cause
