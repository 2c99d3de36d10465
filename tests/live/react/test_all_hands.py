"""Who is asked to carry an action out where ROS 1 and ROS 2 are observed at once."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from roslens.live.react.all_hands import AllHands
from roslens.live.react.node_places import NodePlaces
from roslens.model.acting.condition import Stated
from roslens.model.acting.order import VERSION, Reply, Verb
from roslens.model.acting.reaction import ActionCall, Decision, EscalationStep, Reaction
from roslens.model.entity import EntityId, EntityKind
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.selector import Selector

ENDS = (
    Endpoint("/old", Role.PUBLISHER, "/rosout", "rosgraph_msgs/Log"),
    Endpoint("/new", Role.PUBLISHER, "/rosout", "rcl_interfaces/msg/Log"),
    Endpoint("/bridge", Role.PUBLISHER, "/scan", "sensor_msgs/LaserScan"),
    Endpoint("/bridge", Role.SUBSCRIPTION, "/scan", "sensor_msgs/msg/LaserScan"),
)


class Line:
    """A process that acts in one ROS, of which only its orders are kept."""

    def __init__(self, generation):
        self.generation = generation
        self.reported, self.paths, self.prepared, self.replies = [], [], [], []

    def prepare(self, id_, kind, target, arguments):
        self.prepared.append((id_, kind))

    def do(self, id_, kind, target, arguments):
        self.reported.append((kind, target))
        if kind == "record":
            self.paths.append((id_, arguments["path"]))

    def poll(self):
        found, self.replies = self.replies, []
        return found


class Scene:
    def __init__(self):
        self.lines = [Line(1), Line(2)]
        places = NodePlaces()
        places.take(Graph("ros1+ros2", endpoints=ENDS))
        places.take(Graph("ros1+ros2"))
        self.hands = AllHands(
            self.lines, places, "here", here=None, far=None, recordings=Path("r"), monitor=lambda _: lambda: "kept"
        )

    def do(self, kind, node=""):
        target = EntityId(EntityKind.NODE, node) if node else None
        arguments = {"name": "speed", "value": 1} if node else {"topic": "/stop", "type": "std_msgs/Bool"}
        self.hands.do(Decision("r/1.1", "r", "node:/x", 0, ActionCall(kind, target, arguments), 1.0))
        return [len(one.reported) for one in self.lines], [one.text for one in self.hands.poll()]


@pytest.mark.parametrize(("node", "asked"), [("/old", [1, 0]), ("/new", [0, 1])])
def test_a_node_that_is_gone_is_acted_upon_in_the_ros_that_it_was_seen_in(node, asked):
    assert Scene().do("set_parameter", node) == (asked, [])


@pytest.mark.parametrize(("node", "why"), [("/bridge", "is in both"), ("/nobody", "no node of that name")])
def test_what_cannot_be_told_is_left_alone(node, why):
    asked, (text,) = Scene().do("set_parameter", node)
    assert asked == [0, 0]
    assert why in text


def test_what_has_no_target_is_done_in_both():
    assert Scene().do("publish") == ([1, 1], [])


def test_what_was_said_on_rosout_is_put_beside_a_snapshot():
    scene = Scene()
    step = EscalationStep(ActionCall("snapshot"))
    scene.hands.prepare([Reaction("r", Stated(Selector(EntityKind.NODE, "/x")), (step,))])
    assert [one.prepared for one in scene.lines] == [[("rosout/prepare", "record")]] * 2
    scene.hands.do(Decision("r/1.1", "r", "node:/x", 0, step.action, 1.0))
    found = []
    end = time.monotonic() + 20
    while not scene.lines[1].paths:
        found += scene.hands.poll()
        assert time.monotonic() < end
    assert found == []
    assert scene.lines[1].paths == [("rosout/r/1.1", "snapshots/19700101T000001-r_1.1/rosout-ros2.mcap")]
    for line, done, text in ((scene.lines[0], False, "no master"), (scene.lines[1], True, "3 messages")):
        line.replies = [Reply(VERSION, "rosout/r/1.1", Verb.DO, done, text)]
        found += scene.hands.poll()
    (one,) = found
    assert (one.decision, one.done, one.text) == ("r/1.1", True, "kept; without /rosout: no master; 3 messages")


def test_without_snapshots_nothing_of_rosout_is_kept():
    scene = Scene()
    scene.hands.prepare([Reaction("r", Stated(Selector(EntityKind.NODE, "/x")), (EscalationStep(ActionCall("stop")),))])
    assert [one.prepared for one in scene.lines] == [[], []]
