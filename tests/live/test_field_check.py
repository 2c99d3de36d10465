"""Fields of messages: patterns of topics, steps, differences, and messages between two looks."""

from __future__ import annotations

import pytest

from roslens.judge.reading.read_reference import GivenText, load_reference
from roslens.live.rate.monitor import Monitor
from roslens.live.replay.replay import wanted_fields
from roslens.live.window.signals import BY_KEY
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.verdict import State

HEAD = "kind: reference\nname: r\ndefaults: {grace: 0 s}\nfields:\n"


def reference(*lines):
    text = HEAD + "".join(f"  - {line}\n" for line in lines)
    return load_reference([GivenText("r.yaml", text.encode())], BY_KEY)


class Watch:
    """A monitor that is given messages and looked at every half second."""

    def __init__(self, *lines):
        self.monitor = Monitor(reference(*lines), start=0.0)
        self.reported = []

    def look(self, now, *messages):
        """Take messages (time, topic, fields), look, and return what changed by topic and id."""
        for time, topic, fields in messages:
            self.monitor.add_field(topic, time, fields)
        found = {(one.entity.name, one.expectation): one for one in self.monitor.tick(now)}
        self.reported += found.values()
        return {key: one.state for key, one in found.items()}


def test_a_pattern_is_about_each_topic_that_matches():
    watch = Watch('{topic: "/wheel_*/encoder", without: /wheel_9/*, field: ticks, range: 0..10}')
    changed = watch.look(0.5, *((0.1, f"/wheel_{number}/encoder", {"ticks": number * 6}) for number in (1, 2, 9)))
    key = "r.field.wheel_*.encoder.ticks.value"
    assert changed == {("/wheel_1/encoder", key): State.OK, ("/wheel_2/encoder", key): State.HIGH}


def test_a_type_narrows_the_choice():
    watch = Watch('{topic: "**", type: my/Encoder, field: ticks, range: 0..10}')
    ends = tuple(Endpoint("/n", Role.PUBLISHER, topic, type_) for topic, type_ in (("/a", "my/Encoder"), ("/b", "x/Y")))
    watch.monitor.add_graph(Graph("ros1", (), ends), 0.0)
    changed = watch.look(0.5, (0.1, "/a", {"ticks": 11}), (0.1, "/b", {"ticks": 11}))
    assert changed == {("/a", "r.field.**.ticks.value"): State.HIGH}


def test_a_step_is_seen_though_the_messages_around_it_are_fine():
    watch = Watch("{topic: /encoder, field: ticks, change: -5..5}")
    steady = [(number * 0.1, "/encoder", {"ticks": number * 2}) for number in range(1, 5)]
    assert watch.look(0.5, *steady) == {("/encoder", "r.field.encoder.ticks.change"): State.OK}
    # One message is off, and the next is where it should be: a step up and one down between two looks.
    off = [(0.6, "/encoder", {"ticks": 10}), (0.7, "/encoder", {"ticks": 400}), (0.8, "/encoder", {"ticks": 14})]
    assert watch.look(1.0, *off, (0.9, "/encoder", {"ticks": 16})) == {
        ("/encoder", "r.field.encoder.ticks.change"): State.HIGH
    }
    reported = watch.reported[-1]
    assert (reported.value, reported.quantity, reported.evidence) == (390.0, "change of ticks", "from 10 to 400")
    assert reported.since == pytest.approx(0.7)
    assert watch.look(1.5, (1.4, "/encoder", {"ticks": 18})) == {("/encoder", "r.field.encoder.ticks.change"): State.OK}


def test_a_value_that_is_wrong_in_one_message_between_two_looks_is_seen():
    watch = Watch("{topic: /battery, field: volts, range: '>= 11'}")
    assert watch.look(0.5, *((at, "/battery", {"volts": volts}) for at, volts in ((0.1, 12), (0.2, 3), (0.3, 12)))) == {
        ("/battery", "r.field.battery.volts.value"): State.LOW
    }
    assert watch.reported[-1].value == 3
    assert watch.look(1.0) == {("/battery", "r.field.battery.volts.value"): State.OK}


def test_a_counter_that_stands_while_the_robot_drives():
    watch = Watch(
        "{topic: /encoder, field: ticks, change: '>= 1', for: 0.5 s, "
        "when: {topic: /cmd_vel, field: linear.x, range: '>= 0.1'}}"
    )
    key = ("/encoder", "r.field.encoder.ticks.change")
    assert watch.look(0.5, *((at / 10, "/encoder", {"ticks": 7}) for at in range(5))) == {}
    assert watch.look(1.0, (0.6, "/cmd_vel", {"linear.x": 0.0}), (0.7, "/encoder", {"ticks": 7})) == {
        key: State.SUSPENDED
    }
    driving = [(1.1, "/cmd_vel", {"linear.x": 0.4}), (1.2, "/encoder", {"ticks": 9}), (1.3, "/encoder", {"ticks": 9})]
    assert watch.look(1.5, *driving)[key] is not State.LOW
    assert watch.look(2.0, *((1.3 + at / 10, "/encoder", {"ticks": 9}) for at in range(1, 7))) == {key: State.LOW}
    assert watch.reported[-1].value == 0


def test_messages_that_are_wrong_in_turn_are_not_wrong_for_long():
    watch = Watch("{topic: /x, field: v, range: 0..1, for: 1 s}")
    for step in range(8):
        now = step * 0.5
        changed = watch.look(now + 0.5, (now + 0.1, "/x", {"v": 5}), (now + 0.3, "/x", {"v": 0.5}))
        assert State.HIGH not in changed.values()


def test_two_fields_of_a_message_and_of_two_topics_are_compared():
    watch = Watch(
        "{topic: /wheels, field: left, difference: -1..1, to: {field: right}}",
        "{id: axles, topic: /front, field: ticks, difference: -10..10, to: {topic: /rear, field: ticks}}",
    )
    changed = watch.look(
        0.5, (0.1, "/wheels", {"left": 3.0, "right": 2.5}), (0.1, "/rear", {"ticks": 5}), (0.2, "/front", {"ticks": 9})
    )
    assert changed == {
        ("/wheels", "r.field.wheels.left.difference"): State.OK,
        ("/front", "r.axles.difference"): State.OK,
    }
    changed = watch.look(1.0, (0.6, "/wheels", {"left": 3.0, "right": 6.5}), (0.7, "/front", {"ticks": 90}))
    assert changed == {
        ("/wheels", "r.field.wheels.left.difference"): State.LOW,
        ("/front", "r.axles.difference"): State.HIGH,
    }
    reported = {one.entity.name: one for one in watch.reported[-2:]}
    assert (reported["/wheels"].value, reported["/wheels"].quantity) == (-3.5, "left - right")
    assert (reported["/front"].value, reported["/front"].quantity) == (85, "ticks - /rear ticks")


def test_without_the_other_field_a_difference_is_unknown():
    watch = Watch("{topic: /front, field: ticks, difference: -1..1, to: {topic: /rear, field: ticks}}")
    assert watch.look(0.5, (0.1, "/front", {"ticks": 9})) == {}
    (verdict,) = watch.monitor.standing()
    assert (verdict.state, verdict.evidence) == (State.UNKNOWN, "ticks of /rear is unknown")


def test_what_is_the_same_in_another_reference_keeps_its_state():
    line = '{topic: "/wheel_*", field: ticks, change: -5..5}'
    watch = Watch(line)
    watch.look(0.5, *((at / 10, "/wheel_1", {"ticks": at * 50}) for at in range(3)))
    before = {(v.entity, v.expectation): (v.state, v.since) for v in watch.monitor.standing()}
    assert [state for state, _ in before.values()] == [State.HIGH]
    watch.monitor.replace_reference(reference(line, "{topic: /wheel_1, field: ticks, range: '>= 0'}"))
    assert watch.look(1.0) == {}
    after = {(v.entity, v.expectation): (v.state, v.since) for v in watch.monitor.standing()}
    assert before.items() <= after.items()
    assert len(after) == 2
    assert watch.look(1.5, (1.2, "/wheel_1", {"ticks": 101})) == {
        ("/wheel_1", "r.field.wheel_*.ticks.change"): State.OK,
        ("/wheel_1", "r.field.wheel_1.ticks.value"): State.OK,
    }


def test_of_a_recording_only_the_fields_that_are_asked_for_are_read():
    asked = reference(
        '{topic: "/wheel_*", type: my/Encoder, field: ticks, change: -5..5}',
        "{topic: /wheel_1, field: ticks, difference: -9..9, to: {topic: /wheel_2, field: ticks}, "
        "when: {topic: /cmd_vel, field: linear.x, range: '>= 0.1'}}",
        '{topic: "/arm_*", field: left, difference: -1..1, to: {field: right}}',
    )
    topics = [
        ("/wheel_1", "my/Encoder"),
        ("/wheel_2", "other/Type"),
        ("/cmd_vel", "t/T"),
        ("/arm_1", "t/T"),
        ("/x", ""),
    ]
    assert wanted_fields(asked, topics) == {
        "/arm_1": ["left", "right"],
        "/cmd_vel": ["linear.x"],
        "/wheel_1": ["ticks"],
        "/wheel_2": ["ticks"],
    }
    assert wanted_fields(asked, [("/wheel_3", "my/Encoder")]) == {"/wheel_3": ["ticks"]}
