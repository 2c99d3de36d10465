"""How the process of a node that is gone ended, and what else went with it, whatever is reported first."""

import itertools

import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.rate.monitor import Monitor
from roslens.live.standing.process_fates import ProcessFates
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId
from roslens.model.graph import Change, Event, Graph, Node
from roslens.model.verdict import State

BEFORE = Graph("ros2", (Node("/a", "robot", 7), Node("/b", "robot", 7), Node("/other", "robot", 8)))
COMMAND = "/opt/ros/lib/rclcpp_components/component_container --ros-args"


def end(entity, how="", said=(), command=""):
    return Event(10.0, Change.VANISHED, entity, command, how, said)


def told(fates, *events):
    for event in events:
        fates.happened(event, EntityId.parse(event.entity))


def test_signal_process_container_components_and_last_words_are_named():
    fates = ProcessFates()
    fates.take_graph(BEFORE)
    events = [
        end("process:robot/7", "signal 11", ("[INFO] x", "[ERROR] out of range\x1b[31m"), COMMAND),
        end("node:/a", "signal 11"),
    ]
    for order in itertools.permutations(events):
        fates = ProcessFates()
        fates.take_graph(BEFORE)
        told(fates, *order)
        fates.take_graph(Graph("ros2", BEFORE.nodes[2:]))
        assert fates.of("/a") == (
            "its process 7 (component_container) on robot crashed (SIGSEGV), and with it /b; "
            "its log ends with: [INFO] x | [ERROR] out of range?[31m"
        )
    assert fates.of("/other") == ""


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ("signal 2", "ended in order (SIGINT)"),
        ("exit 0", "ended in order (exit 0)"),
        ("exit 1", "crashed (exit 1)"),
        ("unknown", "ended, and nobody saw how"),
    ],
)
def test_an_end_in_order_is_no_crash(how, words):
    fates = ProcessFates()
    fates.take_graph(BEFORE)
    told(fates, end("process:robot/8", how))
    assert fates.of("/other") == f"its process 8 on robot {words}"


def test_who_knows_how_it_ended_is_right():
    fates = ProcessFates()
    fates.take_graph(BEFORE)
    told(fates, end("node:/other", "unknown"), end("process:robot/8", "signal 9"), end("node:/other", "unknown"))
    assert "crashed (SIGKILL)" in fates.of("/other")


def test_of_a_node_that_was_started_again_the_end_of_its_process_before_is_no_fate():
    fates = ProcessFates()
    fates.take_graph(BEFORE)
    told(fates, end("process:robot/8", "signal 9"))
    fates.take_graph(Graph("ros2", (Node("/other", "robot", 9),)))
    assert fates.of("/other") == ""


def test_what_is_not_the_end_of_a_process_is_none():
    fates = ProcessFates()
    fates.take_graph(BEFORE)
    told(fates, end("node:/other"), end("topic:/t"), Event(1.0, Change.APPEARED, "process:robot/8"))
    assert fates.of("/other") == ""


def test_the_alarm_about_a_node_that_crashed_says_so():
    text = b"kind: reference\nname: r\nconstraints:\n  - {node: /a, expected: always}\n"
    monitor = Monitor(load_reference([GivenText("r.yaml", text)], BY_KEY), start=0.0)
    monitor.add_graph(BEFORE, 1.0)
    monitor.tick(30.0)
    monitor.add_event(Event(31.0, Change.VANISHED, "process:robot/7", COMMAND, "signal 9"))
    monitor.add_graph(Graph("ros2", BEFORE.nodes[2:]), 31.0)
    (verdict,) = monitor.tick(31.1)
    assert verdict.state is State.ABSENT
    assert verdict.evidence == (
        "node /a is not there; its process 7 (component_container) on robot crashed (SIGKILL), and with it /b"
    )
