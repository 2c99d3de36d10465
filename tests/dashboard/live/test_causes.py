"""The small graph of causes: who stands where, what is drawn once, and what does not fit."""

from __future__ import annotations

import re

import pytest
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.dashboard.live.causes import BETWEEN, HIGH, MARGIN, MOST_BOXES, WIDE, Step, cause_picture

LETTERS, LETTER = 25, 6.2
"""As many as the evidence on a line has at most, and how wide one is."""


def step(effect, cause, evidence="is gone"):
    return Step(effect, cause, "is published by", evidence)


def columns(picture):
    return {one.entity: round((one.x - MARGIN) / (WIDE + BETWEEN)) for one in picture.boxes}


def test_first_causes_stand_at_the_left_and_what_is_shared_is_drawn_once():
    ways = [
        [step("topic:/b", "node:/n", ""), step("node:/n", "host:h")],
        [step("topic:/a", "node:/n"), step("node:/n", "host:h")],
    ]
    picture = cause_picture(ways, {"topic:/a": "absent", "host:h": "absent"})
    assert columns(picture) == {"host:h": 0, "node:/n": 1, "topic:/a": 2, "topic:/b": 2}
    assert [one.entity for one in picture.boxes if one.first] == ["host:h"]
    assert {one.entity: one.state for one in picture.boxes}["node:/n"] == "unjudged"
    drawn = [(picture.boxes[one.effect].entity, picture.boxes[one.cause].entity, one.evidence) for one in picture.lines]
    assert drawn == [
        ("node:/n", "host:h", "is gone"), ("topic:/a", "node:/n", "is gone"), ("topic:/b", "node:/n", "")
    ]  # fmt: skip
    places = [(one.x, one.y) for one in picture.boxes]
    assert len(set(places)) == len(places)


def test_an_alert_on_the_way_to_a_graver_one_is_a_first_cause_in_both():
    ways = [[step("topic:/b", "topic:/a"), step("topic:/a", "node:/n")]]
    picture = cause_picture(ways, {"topic:/a": "low"}, {"topic:/a", "node:/n"})
    assert [one.entity for one in picture.boxes if one.first] == ["node:/n", "topic:/a"]


def test_no_curve_goes_through_words():
    """A line changes its height beside its cause, and is straight where the words about it stand."""
    ways = [[step(f"topic:/{number}", "node:/n")] for number in range(5)]
    picture = cause_picture([*ways, [step("node:/n", "host:h")]], {})
    assert len(picture.lines) == 6
    for one in picture.lines:
        *_, bent, level, end = map(float, re.findall(r"-?[\d.]+", one.path))
        effect = picture.boxes[one.effect]
        assert one.path.endswith(f"H{effect.x:g}")
        assert end == effect.x
        assert level == effect.y + HIGH / 2
        assert bent <= one.x - LETTERS * LETTER / 2
        assert one.x + LETTERS * LETTER / 2 <= effect.x


def test_nothing_explained_is_no_graph():
    assert cause_picture([], {"topic:/a": "low"}).boxes == ()


def test_a_circle_ends():
    picture = cause_picture([[step("node:/a", "node:/b"), step("node:/b", "node:/a")]], {})
    assert len(picture.boxes) == 2


def test_what_does_not_fit_is_said():
    picture = cause_picture([[step(f"topic:/{number}", "node:/n")] for number in range(60)], {})
    assert len(picture.boxes) == MOST_BOXES
    assert picture.left_out == "21 more faults that follow from others"


@pytest.fixture
def robot():
    found = ScriptedRobot()
    found.rates["/scan"] = 4
    found.run(5)
    return found


def test_a_node_that_is_gone_explains_what_is_missing():
    robot = ScriptedRobot(
        reference="kind: reference\nname: r\ndefaults: {grace: 0 s}\nconstraints:\n"
        '  - {topic: /scan, rate: ">= 8 Hz", severity: error}\n  - {node: /lidar, expected: always, severity: error}\n'
    )
    robot.gone.add("/lidar")
    robot.rates["/scan"] = 0
    robot.run(8)
    picture = robot.page.snapshot(robot.session, robot.now, "").causes
    assert columns(picture) == {"node:/lidar": 0, "topic:/scan": 1}
    (line,) = picture.lines
    assert line.relation == "is published by"
    assert line.evidence
