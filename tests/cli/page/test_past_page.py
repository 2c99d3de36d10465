"""The past of a watch, read back from its history: each moment as the page showed it when it was now."""

from __future__ import annotations

import json

import msgspec
import pytest
from dashboard.live.scripted_robot import ScriptedRobot, large_robot

from roslens.dashboard.live.snapshot import Snapshot

pytestmark = pytest.mark.timed


def snapshot(text):
    return msgspec.json.decode(text, type=Snapshot)


def blamed(alert):
    """Return an alert without its evidence, which is that of when it began, and its reason, which is told of now."""
    follows = tuple(map(blamed, alert.follows))
    return msgspec.structs.replace(alert, evidence="", why="", follows=follows)


def reported(found, *, values=False):
    """Return what a snapshot says, without what only follows from when it was made."""
    return {
        "rows": [
            (row.entity, row.key, row.name, row.depth, row.state, row.worst, row.below, row.counts)
            + ((row.shown,) if values else ())
            for row in found.rows
        ],
        "counts": (found.state, found.counts, found.unjudged),
        "alerts": tuple(map(blamed, found.alerts)),
        "items": {(one.entity, one.state) for one in found.picture.items},
        "places": {(one.entity, one.x, one.y) for one in found.picture.items},
    }


def run_with_faults(robot):
    """Let things go wrong and well again; return the snapshots by their time."""
    seen = {}

    def run(seconds):
        for _ in range(seconds):
            robot.run()
            seen[robot.now] = snapshot(robot.page.newest())

    run(4)
    robot.cpu["rover"] = 99.0
    run(4)
    robot.gone.add("/lidar")
    run(12)
    robot.gone.clear()
    run(10)
    robot.rates["/odom"] = 12
    robot.cpu.clear()
    run(8)
    return seen


def test_every_moment_is_shown_as_it_was():
    robot = ScriptedRobot()
    for time, then in run_with_faults(robot).items():
        again = snapshot(robot.page.past.snapshot(time))
        assert again.time == time
        assert reported(again) == reported(then), time


def places_of(found):
    return {one.entity: (one.x, one.y) for one in found.picture.items}


def seen_then(robot, times):
    return [snapshot(robot.page.past.snapshot(time)) for time in times]


def test_what_is_drawn_stands_at_one_place_in_all_moments():
    """Most nodes start late, and one of them ends before the others start: each moment is drawn where all have room."""
    robot = ScriptedRobot()
    everything = set(robot.nodes)
    robot.gone = everything - {"/lidar", "/ui"}
    robot.run(400)
    early = robot.now
    robot.gone = everything - {"/lidar", "/slam", "/camera"}
    robot.run(5)
    between = robot.now
    robot.gone = {"/ui"}
    robot.run(5)
    now = places_of(snapshot(robot.page.newest()))
    times = [early, between, robot.now, between, early]
    moments = [places_of(one) for one in seen_then(robot, times)]
    for then in moments:
        assert {entity: now[entity] for entity in then if entity in now} == {
            entity: place for entity, place in then.items() if entity in now
        }
    assert moments[0] == moments[4]
    assert moments[1] == moments[3]


def test_places_hold_where_topics_are_lines_now_and_hosts_were_fewer_then():
    robot = large_robot(200)
    everything = set(robot.nodes)
    few = sorted(everything)[:6]
    robot.gone = everything - set(few)
    robot.run(400)
    early = robot.now
    robot.gone = set()
    robot.run(3)
    now = snapshot(robot.page.newest())
    (then,) = seen_then(robot, [early])
    assert then.picture.as_lines
    places = places_of(now)
    drawn = {entity: place for entity, place in places_of(then).items() if entity.startswith("node:")}
    assert len(drawn) >= len(few)
    assert drawn == {entity: places[entity] for entity in drawn}


def test_pictures_of_other_moments_have_versions_of_their_own():
    robot = ScriptedRobot()
    robot.run(5)
    early = robot.now
    robot.gone.add("/camera")
    robot.run(400)
    (then,) = seen_then(robot, [early])
    now = snapshot(robot.page.newest())
    assert then.picture.version != now.picture.version or then.picture == now.picture


def test_values_are_those_of_then():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 9
    robot.run(5)
    then = snapshot(robot.page.newest())
    robot.rates["/scan"] = 12
    robot.run(60)
    again = snapshot(robot.page.past.snapshot(then.time))
    assert reported(again, values=True) == reported(then, values=True)


def test_a_node_that_died_under_a_busy_host_is_named_first_then_too():
    robot = ScriptedRobot()
    robot.cpu["rover"] = 99.0
    robot.run(4)
    robot.gone.add("/lidar")
    robot.run(8)
    killed = robot.now
    robot.gone.clear()
    robot.cpu.clear()
    robot.run(60)
    assert snapshot(robot.page.newest()).alerts == ()
    first = snapshot(robot.page.past.snapshot(killed)).alerts[0]
    assert (first.entity, first.severity) == ("node:/lidar", "error")
    assert first.message == "is gone → /scan silent → /planner, /slam without input"


def test_what_is_asked_of_before_the_beginning_is_nothing():
    robot = ScriptedRobot()
    assert robot.page.past.snapshot(-1.0) == b""
    assert robot.page.past.detail("topic:/scan", -1.0) == b""
    assert robot.page.past.compared(-1.0, 3.0) is None


def test_a_detail_of_then_has_value_expected_state_and_since():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(5)
    bad = robot.now
    robot.rates.clear()
    robot.run(30)
    found = json.loads(robot.page.past.detail("topic:/scan", bad))
    (judged,) = found["judgements"]
    assert (judged["state"], judged["value"], judged["expected"]) == ("low", "4 Hz", "8..12 Hz")
    assert judged["where"].startswith("rover.yaml:")
    assert {"rate", "bandwidth", "publishers"} <= {one["key"] for one in found["values"]}
    assert found["observed"] == "scripted"


def test_plots_have_the_allowed_band_and_judged_signals_first():
    robot = ScriptedRobot()
    robot.run(20)
    robot.rates["/scan"] = 4
    robot.run(10)
    plots = robot.page.past.plots("topic:/scan", robot.now - 25, robot.now, 300)
    rate, *others = plots.series
    assert (rate.key, rate.unit, rate.low, rate.high, rate.expected) == ("rate", "Hz", 8.0, 12.0, "8..12 Hz")
    assert "bandwidth" in {one.key for one in others}
    assert list(rate.times) == sorted(rate.times)
    assert rate.values[0] == 10
    assert rate.values[-1] == 4
    host = robot.page.past.plots("host:rover", 0, robot.now, 300)
    assert next((one.key, one.low, one.high) for one in host.series) == ("cpu", None, 95.0)


def test_what_was_not_observed_is_a_gap():
    robot = ScriptedRobot()
    robot.run(10)
    robot.gone.add("/slam")
    robot.run(40)
    robot.gone.clear()
    robot.run(10)
    (cpu,) = (one for one in robot.page.past.plots("node:/slam", 0, robot.now, 300).series if one.key == "cpu")
    missing = [time for time, value in zip(cpu.times, cpu.values, strict=True) if value is None]
    assert len(missing) == 1
    assert 15 < missing[0] < 60


def test_points_are_bounded_however_long_the_stretch():
    robot = ScriptedRobot()
    for second in range(0, 40_000, 10):
        robot.keeper._history.add_values("host:rover", 1000.0 + second, {"cpu": float(second % 100)})
    robot.keeper.end()
    for length in (100, 1000, 10_000, 39_000):
        (cpu,) = robot.page.past.plots("host:rover", 41_000 - length, 41_000, 200).series
        assert 5 <= len(cpu.times) <= 300, length


def test_sparks_are_shares_with_gaps():
    robot = ScriptedRobot()
    robot.run(30)
    robot.rates["/scan"] = 5
    robot.run(30)
    sparks = robot.page.past.sparks(("topic:/scan", "node:/lidar", "topic:/nothing", "odd"), robot.now)
    assert set(sparks) == {"topic:/scan", "node:/lidar"}
    scan = sparks["topic:/scan"]
    assert len(scan) == 60
    assert scan[0] is None
    assert max(one for one in scan if one is not None) == 1.0
    assert [one for one in scan if one is not None][-1] == 0.5


def test_marks_tell_alarms_and_who_went():
    robot = ScriptedRobot()
    robot.run(5)
    robot.gone.add("/lidar")
    robot.run(5)
    robot.gone.clear()
    robot.run(5)
    found = robot.page.past.timeline(0.0, 0.0)
    assert (found.first, found.last) == (1.0, robot.now)
    kinds = {(one.kind, one.entity) for one in found.marks}
    assert ("gone", "node:/lidar") in kinds
    assert any(kind == "alarm" for kind, _ in kinds)
    assert [one.time for one in found.marks] == sorted(one.time for one in found.marks)


def test_two_moments_are_compared_gravest_first():
    robot = ScriptedRobot()
    robot.run(3)
    before = robot.now
    robot.rates["/scan"] = 4
    robot.cpu["/camera"] = 50.0
    robot.nodes["/recorder"] = "base"
    robot.run(8)
    found = robot.page.past.compared(before, robot.now)
    first = found.changed[0]
    assert (first.entity, first.before, first.after) == ("topic:/scan", "ok", "low")
    assert ("Rate", "10 Hz", "4 Hz") in first.values
    by = {one.entity: one for one in found.changed}
    assert by["node:/camera"].values == (("CPU", "12.5 %", "50 %"),)
    assert (by["node:/recorder"].before, by["node:/recorder"].after) == ("", "ok")
    assert "topic:/odom" not in by
    assert found.same > 10
    assert robot.page.past.compared(before, before).changed == ()


def test_a_large_system_is_shown_as_it_was_within_moments():
    robot = large_robot(300)
    then = snapshot(robot.page.newest())
    robot.run(5)
    again = snapshot(robot.page.past.snapshot(then.time))
    assert reported(again) == reported(then)
