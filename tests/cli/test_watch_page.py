"""The document of the live page, made of a session; and `roslens watch --serve` from end to end."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
from itertools import pairwise
from pathlib import Path
from random import Random
from urllib.request import ProxyHandler, build_opener

import pytest
from dashboard.live.scripted_robot import OF_ALL, ScriptedRobot, large_robot, written

from roslens.cli.page.row_list import RECORDED, RowList
from roslens.cli.page.watch_graph import MOST_DRAWN, GraphPicture
from roslens.cli.page.watch_page import PageSource
from roslens.cli.page.watch_screen import value_text
from roslens.cli.watch.watch_serve import address_of
from roslens.dashboard.computation.picture import MANY
from roslens.dashboard.live.snapshot import Row
from roslens.live.join.session import Step
from roslens.model.entity import EntityId, EntityKind
from roslens.model.errors import UsageError
from roslens.model.graph import Change, Event, Graph
from roslens.model.verdict import State, Verdict

pytestmark = pytest.mark.timed

ROOT = Path(__file__).parents[2]


def document(robot):
    return json.loads(robot.page.newest())


def row(found, entity):
    return next(one for one in found["rows"] if one["entity"] == entity)


def test_the_tree_stands_in_order_with_values_as_the_terminal_writes_them():
    found = document(ScriptedRobot())
    assert [one["depth"] for one in found["rows"][:4]] == [0, 1, 2, 3]
    assert len({one["key"] for one in found["rows"]}) == len(found["rows"])
    image = row(found, "topic:/image")
    assert image["shown"]["bandwidth"] == value_text("bandwidth", image["values"]["bandwidth"]) == "13.8 MB/s"
    assert image["observer"] == "scripted"
    assert row(found, "node:/slam")["shown"] == {"cpu": "12.5 %", "memory": "84 MB"}
    assert [key for key, _ in found["columns"]] == [
        "rate", "rate_received", "largest_gap", "latency", "bandwidth", "cpu", "memory",
    ]  # fmt: skip
    assert row(found, "connection:/lidar > /scan > /slam")["name"] == "→ /slam"


def test_a_topic_of_two_publishers_has_two_rows_with_keys_that_last():
    robot = ScriptedRobot(
        {"/a": "x", "/b": "x", "/c": "x"}, [("/a", "/t", ("/c",), 10, 1), ("/b", "/t", ("/c",), 10, 1)]
    )
    before = [one["key"] for one in document(robot)["rows"] if one["entity"] == "topic:/t"]
    robot.run()
    assert len(set(before)) == 2
    assert [one["key"] for one in document(robot)["rows"] if one["entity"] == "topic:/t"] == before


def test_alerts_are_first_causes_with_what_follows():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(5)
    robot.rates["/cmd_vel"] = 0
    robot.run(8)
    first, *others = document(robot)["alerts"]
    assert (first["entity"], first["state"], first["severity"]) == ("topic:/scan", "low", "error")
    assert (first["name"], first["group"]) == ("/scan", "driving")
    assert first["where"].startswith("rover.yaml:")
    assert 5 <= first["since"] <= 8
    assert [one["entity"] for one in first["follows"]] == ["topic:/cmd_vel"]
    assert first["follows"][0]["cause"] == "topic:/scan"
    assert "because of" not in first["follows"][0]["message"]
    assert not others


def test_a_node_that_is_gone_is_told_before_a_busy_host_with_what_it_leads_to():
    robot = ScriptedRobot()
    robot.cpu["rover"] = 99.0
    robot.run(4)
    robot.gone.add("/lidar")
    robot.rates["/scan"] = 0
    robot.run(8)
    first, *others = document(robot)["alerts"]
    assert (first["entity"], first["state"], first["severity"]) == ("node:/lidar", "absent", "error")
    assert first["message"] == "is gone → /scan silent → /planner, /slam without input"
    assert "topic:/scan" in [one["entity"] for one in first["follows"]]
    assert [(one["entity"], one["severity"]) for one in others] == [("host:rover", "warning")]


def test_what_was_low_before_its_node_was_absent_is_told_under_the_node_as_why_draws_it():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(10)
    assert [one["entity"] for one in document(robot)["alerts"]] == ["topic:/scan"]
    robot.gone.add("/lidar")
    robot.rates["/scan"] = 0
    robot.run(5)
    found = document(robot)
    (first,) = found["alerts"]
    assert first["entity"] == "node:/lidar"
    scan = next(one for one in first["follows"] if one["entity"] == "topic:/scan")
    assert scan["message"] == (
        "is silent, expected 8..12 Hz; Look at the cable of the lidar; "
        "out of range since 12:00:07.0, its node absent since 12:00:17.0"
    )
    boxes = found["causes"]["boxes"]
    assert [one["entity"] for one in boxes if one["first"]] == ["node:/lidar"]
    assert "topic:/scan" in [one["entity"] for one in boxes]


def test_an_observer_that_is_not_heard_is_the_first_cause_of_what_is_unknown():
    robot = ScriptedRobot()
    robot.cpu["rover"] = 99.0
    robot.run(3)
    for step in range(1, 9):
        robot.page.take(robot.session.look(robot.now + step / 2))
    robot.page.make(robot.session, robot.now + 4.0, "")
    found = document(robot)
    first = found["alerts"][0]
    assert (first["entity"], first["state"], first["since"]) == ("observer:ros2", "unknown", robot.now)
    assert first["message"].startswith("nothing from the observer ros2")
    assert {"topic:/scan", "topic:/odom", "host:rover"} <= {one["entity"] for one in first["follows"]}
    assert not any(one["state"] in ("low", "high", "absent") for one in found["alerts"])
    assert found["happened"][0]["state"] == "unknown"
    robot.now += 4.0
    robot.run(6)
    assert [one["entity"] for one in document(robot)["alerts"]] == ["host:rover"]


def test_the_picture_has_every_line_with_its_rate_and_state():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(5)
    picture = document(robot)["picture"]
    names = [one["entity"] for one in picture["items"]]
    lines = {(names[one["start"]], names[one["end"]]): one for one in picture["links"]}
    assert len(lines) == sum(1 + len(wire[2]) for wire in robot.wires)
    assert lines["node:/lidar", "topic:/scan"]["rate"] == "4 Hz"
    assert lines["node:/lidar", "topic:/scan"]["state"] == "low"
    assert lines["topic:/odom", "node:/slam"]["latency"] == "2.1 ms"
    states = {one["entity"]: one.get("state", "unjudged") for one in picture["items"]}
    assert states["topic:/scan"] == "low"
    assert states["node:/lidar"] == "ok", "a node is not what its topics are"


def test_what_no_constraint_judges_is_not_called_ok():
    robot = ScriptedRobot()
    robot.nodes["/recorder"] = "base"
    robot.wires.append(("/recorder", "/recorder/size", ("/ui",), 1, 8))
    robot.run(8)
    found = document(robot)
    assert row(found, "topic:/recorder/size")["state"] == "unjudged"
    states = {one["entity"]: one.get("state", "unjudged") for one in found["picture"]["items"]}
    assert states["topic:/recorder/size"] == "unjudged"
    lines = {(one["start"], one["end"]): one.get("state", "unjudged") for one in found["picture"]["links"]}
    place = [one["entity"] for one in found["picture"]["items"]].index("topic:/recorder/size")
    assert {state for ends, state in lines.items() if place in ends} == {"unjudged"}
    assert found["unjudged"] == len({one["entity"] for one in found["rows"] if one["state"] == "unjudged"})


def test_a_row_has_its_own_state_and_what_is_wrong_below_apart():
    robot = ScriptedRobot()
    robot.rates["/scan"] = 4
    robot.run(5)
    found = document(robot)
    host, topic = row(found, "host:rover"), row(found, "topic:/scan")
    assert (host["state"], host["worst"], host["below"]) == ("ok", "low", "1 low below")
    assert (topic["state"], topic["worst"], topic.get("below", "")) == ("low", "low", "")
    assert found["state"] == "low"


def test_what_happened_is_sorted_by_time_and_leaves_out_programs():
    robot = ScriptedRobot()
    events = [Event(7.0, Change.APPEARED, f"process:base/{pid}", "/bin/sh") for pid in range(60)]
    events += [Event(5.0, Change.VANISHED, "node:/lidar"), Event(6.5, Change.APPEARED, "node:/lidar")]
    late = Verdict(EntityId(EntityKind.TOPIC, "/scan"), "r.scan", "rate", State.LOW, since=6.0, time=7.0, value=1.0)
    page = PageSource("rover", clock=str, live=True, steady=lambda: 0.0)
    page.take(Step(7.0, changes=(late,), events=tuple(events)))
    shown = page.snapshot(robot.session, 8.0, "").happened
    assert [(one.time, one.name) for one in shown] == [(7.0, "/scan"), (6.5, "/lidar"), (5.0, "/lidar")]


SLOW_AND_QUICK = """
kind: reference
name: rover
defaults: {grace: 0 s}
constraints:
  - {topic: /scan, rate: ">= 8 Hz"}
  - {topic: /odom, rate: ">= 45 Hz", for: 4 s}
  - {topic: /image, rate: ">= 10 Hz", for: 9 s}
"""


def test_changes_with_one_beginning_have_the_times_at_which_they_were_judged():
    robot = ScriptedRobot(reference=SLOW_AND_QUICK)
    topics, changed = ("/scan", "/odom", "/image"), {}
    for rates in (dict.fromkeys(topics, 1), {}):
        robot.rates = rates
        for _ in range(30):
            before = {name: row(document(robot), f"topic:{name}")["state"] for name in topics}
            robot.run()
            for name in topics:
                if (state := row(document(robot), f"topic:{name}")["state"]) != before[name]:
                    changed[name, state] = robot.now
    assert len(changed) == 6
    assert len({changed[name, "low"] for name in topics}) == 3
    past = json.loads(robot.page.past.snapshot(robot.now))
    for found in (document(robot), past):
        listed = {(one["name"], one["state"]): one for one in found["happened"] if one["time"] > 6 and one.get("state")}
        assert {key: one["time"] for key, one in listed.items()} == changed
        assert all(one["when"] == written(one["time"]) for one in listed.values())


def test_a_node_that_went_is_still_drawn():
    robot = ScriptedRobot()
    robot.gone.add("/camera")
    robot.run(3)
    found = document(robot)
    states = {one["entity"]: one.get("state", "ok") for one in found["picture"]["items"]}
    assert states["node:/camera"] == "unknown"
    assert any(one["what"] == "vanished" and one["entity"] == "node:/camera" for one in found["happened"])


def test_topics_of_a_large_graph_are_lines_between_nodes():
    robot = large_robot(200)
    picture = document(robot)["picture"]
    assert picture["as_lines"]
    assert {one["kind"] for one in picture["items"]} == {"node"}
    names = [one["entity"] for one in picture["items"]]
    drawn = {(names[one["start"]], topic, names[one["end"]]) for one in picture["links"] for topic in one["by"]}
    wanted = {
        (f"node:{giver}", f"topic:{topic}", f"node:{taker}")
        for giver, topic, takers, *_ in robot.wires
        for taker in takers
        if taker != giver
    }
    assert drawn == wanted


def test_a_bad_topic_that_no_line_stands_for_is_drawn_by_itself():
    rows = [Row(str(place), f"node:/n{place}", f"/n{place}", "node", 1, "ok") for place in range(MANY + 1)]
    rows += [Row("bad", "topic:/bad", "/bad", "topic", 2, "low"), Row("good", "topic:/good", "/good", "topic", 2, "ok")]
    picture = GraphPicture(str).of(Graph("ros2"), rows)
    assert {one.entity for one in picture.items if one.kind == "topic"} == {"topic:/bad"}
    assert [(picture.items[one.start].entity, picture.items[one.end].entity) for one in picture.links] == [
        (f"node:/n{MANY}", "topic:/bad")
    ]


def test_a_graph_beyond_looking_at_is_cut_to_what_is_bad():
    rows = [Row(str(place), f"node:/n{place}", f"/n{place}", "node", 1, "ok") for place in range(MOST_DRAWN + 1)]
    rows += [Row("bad", "topic:/bad", "/bad", "topic", 2, "low")]
    picture = GraphPicture(str).of(Graph("ros2"), rows)
    assert {one.entity for one in picture.items} == {"topic:/bad", f"node:/n{MOST_DRAWN}"}
    assert picture.left_out == "2 of 1,502 are drawn: what is bad and what it is joined to"


def test_nodes_of_several_hosts_stand_in_boxes_of_these():
    picture = document(ScriptedRobot())["picture"]
    assert {box["title"] for box in picture["boxes"]} == {"host rover", "host base"}
    around = {
        box["title"]: {
            one["entity"]
            for one in picture["items"]
            if box["x"] < one["x"] < box["x"] + box["width"] and box["y"] < one["y"] < box["y"] + box["height"]
        }
        for box in picture["boxes"]
    }
    # Topics stand where they are published.
    assert around["host rover"] == {
        "node:/lidar", "node:/camera", "node:/odometry", "topic:/scan", "topic:/image", "topic:/odom"
    }  # fmt: skip
    assert {"node:/slam", "node:/planner", "node:/ui", "topic:/planner/status", "topic:/cmd_vel"} <= around["host base"]
    alone = ScriptedRobot({"/a": "x", "/b": "x"}, [("/a", "/t", ("/b",), 1, 1)], OF_ALL)
    assert "boxes" not in document(alone)["picture"]


def test_no_topic_moves_to_another_host_when_its_publisher_goes():
    robot = ScriptedRobot()
    before = places(document(robot)["picture"])
    robot.gone.add("/lidar")
    robot.run(70)
    after = places(document(robot)["picture"])
    assert after.items() <= before.items()
    assert "topic:/scan" in after


def places(picture):
    return {one["entity"]: (one["x"], one["y"]) for one in picture["items"]}


def test_lines_say_age_and_bandwidth():
    picture = document(ScriptedRobot())["picture"]
    names = [one["entity"] for one in picture["items"]]
    lines = {(names[one["start"]], names[one["end"]]): one for one in picture["links"]}
    assert lines["node:/camera", "topic:/image"]["bandwidth"] == "13.8 MB/s"
    assert lines["topic:/odom", "node:/slam"]["lag"] == pytest.approx(0.0021)


def test_plumbing_is_not_drawn_and_that_is_said():
    robot = ScriptedRobot({"/a": "x", "/b": "x"}, [("/a", "/rosout", ("/b",), 1, 1)], OF_ALL)
    picture = document(robot)["picture"]
    assert {one["entity"] for one in picture["items"]} == {"node:/a", "node:/b"}
    assert picture["left_out"] == "Not drawn: /rosout"


def test_names_that_cannot_be_encoded_do_not_stop_the_page():
    robot = ScriptedRobot({"/a\ud800": "host\udfff", "/b": ""}, [("/a\ud800", "/t\ud801", ("/b",), 1, 1)])
    assert any(one["entity"] == "topic:/t?" for one in document(robot)["rows"])


def test_only_the_latest_happenings_are_kept():
    robot = ScriptedRobot()
    for _ in range(40):
        robot.gone ^= {"/camera", "/ui"}
        robot.run()
    happened = document(robot)["happened"]
    assert len(happened) == 50
    assert happened[0]["time"] == robot.now


def test_snapshots_are_made_four_times_a_second_while_somebody_looks():
    now = [100.0]
    robot = ScriptedRobot()
    page = PageSource("x", clock=str, live=True, steady=lambda: now[0])
    assert page.due()
    page.newest()
    page.make(robot.session, 1.0, "")
    now[0] += 0.24
    assert not page.due()
    now[0] += 0.01
    assert page.due()
    first = page.newest()
    page.make(robot.session, 2.0, "")
    assert page.newest() is not first
    now[0] += 5.0
    page.make(robot.session, 3.0, "")
    now[0] += 4.9
    assert not page.due(), "nobody asked for five seconds"
    now[0] += 0.1
    assert page.due()


def test_who_comes_four_times_a_second_but_unevenly_makes_four_snapshots_a_second():
    now, draw = 100.0, Random(4).random
    robot = ScriptedRobot()
    page = PageSource("x", clock=str, live=True, steady=lambda: now, spent=lambda: 0.0)
    view = page._snapshot

    def lasting(*given, **more):
        nonlocal now
        now += 0.025
        return view(*given, **more)

    page._snapshot = lasting
    made = []
    for turn in range(120):
        now = 100.0 + turn / 4 + 0.02 * draw()
        page.newest()
        if page.due():
            made.append(now)
            page.make(robot.session, now, "")
    assert len(made) >= 4 * 30 - 2
    assert min(after - before for before, after in pairwise(made)) >= 0.125


def shown_for(seconds, cost):
    """Return what a page used while somebody looked, and when it was made; ``cost`` is of one by the time since."""
    now, spent, made = 100.0, 0.0, [100.0]
    robot = ScriptedRobot()
    page = PageSource("x", clock=str, live=True, steady=lambda: now, spent=lambda: spent)
    view = page._snapshot

    def costly(*given, **more):
        nonlocal spent
        spent += cost(now - made[-1])
        return view(*given, **more)

    page._snapshot = costly
    while now < 100.0 + seconds:
        page.newest()
        if page.due():
            page.make(robot.session, now, "")
            made.append(now)
        now += 0.25
    return spent, made


def test_what_costs_less_the_more_often_it_is_made_is_made_often():
    spent, made = shown_for(30.0, lambda since: 0.25 if since == 0 else 0.004 + 0.045 * since)
    assert [after - before for before, after in pairwise(made)][-20:] == [0.25] * 20
    assert spent <= 0.08 * 30 + 0.25


def test_a_beginning_that_costs_much_is_soon_forgotten():
    _, made = shown_for(12.0, lambda since: 2.0 if since == 0 else 0.01)
    assert [after - before for before, after in pairwise(made)][-20:] == [0.25] * 20


def test_a_page_that_costs_much_is_made_seldom_but_made():
    spent, made = shown_for(60.0, lambda _: 0.1)
    assert spent <= 0.08 * 60 + 0.2
    assert len(made) > 40
    _, made = shown_for(60.0, lambda _: 5.0)
    assert {after - before for before, after in pairwise(made[1:])} == {4.0}


@pytest.mark.parametrize(
    ("text", "address"),
    [
        ("8080", ("127.0.0.1", 8080)),
        ("0", ("127.0.0.1", 0)),
        ("0.0.0.0:80", ("0.0.0.0", 80)),
        ("robot.local:8080", ("robot.local", 8080)),
        ("[::1]:8080", ("::1", 8080)),
    ],
)
def test_an_address_is_a_port_or_a_host_and_a_port(text, address):
    assert address_of(text) == address


@pytest.mark.parametrize("text", ["", "x", "-1", "65536", ":80", "host:", "::1:80", "1e3", "80:x", "٣"])
def test_what_is_no_address_is_said(text):
    with pytest.raises(UsageError, match="expected PORT or HOST:PORT"):
        address_of(text)


def test_a_recording_is_served_until_ctrl_c(tmp_path):
    bag = tmp_path / "robot.bag"
    subprocess.run([sys.executable, ROOT / "examples/robot/record.py", bag], check=True, capture_output=True)
    command = [Path(sys.executable).with_name("roslens"), "watch", "--bag", bag, "--serve", "0", "--quiet"]
    command += ["--reference", ROOT / "examples/robot/rover.yaml", "-o", tmp_path / "out"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as watch:
        assert watch.stderr
        match = next((hit for line in watch.stderr if (hit := re.search(r"http://127\.0\.0\.1:\d+/", line))), None)
        assert match
        opener = build_opener(ProxyHandler({}))
        with opener.open(f"{match[0]}snapshot.json", timeout=20) as answer:
            found = json.load(answer)
        watch.send_signal(signal.SIGINT)
        assert watch.wait(20) == 1
    assert not found["live"]
    assert row(found, "topic:/scan")["shown"]["rate"] == "25 Hz"
    assert [one["entity"] for one in found["alerts"]] == ["topic:/cmd_vel", "topic:/planner/status"], (
        "errors come first"
    )
    assert "topic:/cmd_vel" in (tmp_path / "out").read_text()


def test_a_running_system_is_served_while_it_is_watched(tmp_path):
    command = [Path(sys.executable).with_name("roslens"), "watch", "--serve", "0", "--for", "60s", "--listen"]
    key = tmp_path / "key"
    subprocess.run([command[0], "agent", "--new-key", key], check=True, capture_output=True)
    with subprocess.Popen(
        [*command, "127.0.0.1:0", "--key-file", key, "--format", "json"],
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
        env={"PATH": "/usr/bin:/bin"},
    ) as watch:
        assert watch.stderr
        match = next((hit for line in watch.stderr if (hit := re.search(r"http://127\.0\.0\.1:\d+/", line))), None)
        assert match
        with build_opener(ProxyHandler({})).open(f"{match[0]}events", timeout=20) as answer:
            found = (json.loads(line.removeprefix(b"data: ")) for line in answer if line.startswith(b"data: {"))
            assert next(found)["live"]
            # A share of a CPU takes two looks; that there is one then is reported as a change.
            assert any(
                key == "cpu"
                for _, reported in zip(range(20), found, strict=False)
                for key, _ in reported.get("columns") or reported.get("parts", {}).get("columns", ())
            )
        watch.send_signal(signal.SIGINT)
        assert watch.wait(20) in {0, 3}


def test_what_was_recorded_misses_no_host():
    robot = ScriptedRobot(dict.fromkeys(("/a", "/b"), ""), [("/a", "/t", ("/b",), 10, 1)])
    view = robot.session.tree(robot.now)
    rows = RowList()
    names = [
        next(one.name for one in rows.of(view, recorded=recorded) if one.kind == "host")
        for recorded in (False, True, False)
    ]
    assert names == ["(host unknown)", RECORDED, "(host unknown)"]
