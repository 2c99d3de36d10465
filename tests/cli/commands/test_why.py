"""``roslens why``: the first cause of faults that are put into the example workspace, and into recordings of it."""

import json
import shutil
from pathlib import Path

import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from roslens.cli.main import main

ROOT = Path(__file__).parents[3]
ROVER = "src/rover"
LAUNCH = "rover_bringup/rover.launch.py"
STORE = get_typestore(Stores.LATEST)
START_NS = 1_700_000_000_000_000_000


@pytest.fixture
def rover(tmp_path):
    shutil.copytree(ROOT / "examples/workspace", tmp_path / "ws", ignore=shutil.ignore_patterns(".roslens"))
    return tmp_path / "ws"


def asked(capsys, *words):
    """Return exit code and answer of a question."""
    code = main(["why", *map(str, words), "--json", "-q"])
    return code, json.loads(capsys.readouterr().out)


def change(place, before, after):
    text = place.read_text()
    assert before in text
    place.write_text(text.replace(before, after))


def step(answer, asks, of="source"):
    (found,) = (one for one in answer["steps"] if (one["asks"], one["of"]) == (asks, of))
    return found


def test_what_is_whole_has_no_cause_and_says_what_only_a_running_system_tells(rover, capsys):
    code, answer = asked(capsys, "/scan", rover)
    assert (code, answer["cause"], answer["entity"]) == (0, None, "topic:/scan")
    assert step(answer, "made by")["evidence"][0].startswith("/range_filter publishes /scan: src/rover/rover_sensors/")
    assert step(answer, "QoS")["state"] == "ok"
    unseen = [one["asks"] for one in answer["steps"] if one["state"] == "cannot be seen"]
    assert unseen == ["running", "reachable", "sent", "received"]


def test_a_condition_that_is_not_met_is_named_with_its_argument(rover, capsys):
    code, answer = asked(capsys, "/cmd_vel", rover, "--launch", LAUNCH, "--arg", "navigation:=false")
    assert code == 1
    assert answer["cause"]["asks"] == "made by"
    assert "navigation:=true starts it, and navigation is false" in answer["cause"]["says"]
    assert answer["cause"]["command"].endswith("--launch rover_bringup/rover.launch.py --arg navigation:=true")


def test_a_remapping_away_is_named_with_its_line(rover, capsys):
    change(rover / ROVER / "rover_bringup/launch/navigation.launch.xml", 'default="cmd_vel"', 'default="cmd_vel_nav"')
    _, answer = asked(capsys, "/cmd_vel", rover, "--launch", LAUNCH)
    assert "/rover_follower is remapped from /cmd_vel to /cmd_vel_nav at" in answer["cause"]["says"]
    assert "navigation.launch.xml:7" in answer["cause"]["says"]


def test_a_near_miss_of_the_name_is_named(rover, capsys):
    change(rover / ROVER / "rover_sensors/rover_sensors/range_filter.py", '"scan"', '"scans"')
    _, answer = asked(capsys, "/scan", rover, "--launch", LAUNCH)
    assert "/range_filter publishes /scans, which nobody else uses" in answer["cause"]["says"]
    assert answer["cause"]["how"] == "correct or remap one of the two names: /scans and /scan"


def test_quality_of_service_that_does_not_fit_is_named_with_both_lines(rover, capsys):
    shutil.copytree(ROOT / "examples/change", rover, dirs_exist_ok=True)
    _, answer = asked(capsys, "scan", rover)
    assert answer["cause"]["asks"] == "QoS"
    (line,) = answer["cause"]["evidence"]
    assert "battery_guard.cpp:21" in line
    assert "range_filter.py:71" in line
    assert "reliable is requested, best_effort offered" in line


def test_a_name_that_only_another_launch_file_has_is_told_so(rover, capsys):
    _, answer = asked(capsys, "/joy", rover, "--launch", "rover_docking/docking.launch")
    assert answer["cause"]["asks"] == "exists"
    assert "joystick:=true starts it" in answer["cause"]["says"]


def test_a_node_that_is_not_started_says_what_starts_it(rover, capsys):
    _, answer = asked(capsys, "node:/rover_follower", rover, "--launch", LAUNCH, "--arg", "navigation:=false")
    assert answer["cause"]["asks"] == "exists"
    assert "navigation:=true starts it" in answer["cause"]["says"]
    code, answer = asked(capsys, "/rover_follower", rover)
    assert (code, step(answer, "exists")["state"], step(answer, "inputs")["state"]) == (0, "ok", "ok")


def test_an_action_has_its_server_and_its_client(rover, capsys):
    code, answer = asked(capsys, "/follow_mission", rover, "--launch", LAUNCH)
    assert (code, answer["entity"]) == (0, "action:/follow_mission")
    assert step(answer, "made by")["state"] == "ok"


def test_an_unknown_name_and_no_source_are_usage_errors(rover, tmp_path, capsys):
    assert main(["why", "/scam", str(rover), "-q"]) == 2
    assert "Did you mean /scan (topic)" in capsys.readouterr().err
    assert main(["why", "/scan", str(rover), "--no-source"]) == 2
    assert "something to look at" in capsys.readouterr().err
    (tmp_path / "empty").mkdir()
    assert main(["why", "/scan", str(tmp_path / "empty"), "-q"]) == 2
    assert "has no node" in capsys.readouterr().err
    assert main(["why", "map->odom", str(rover), "-q"]) == 2
    assert "transform" in capsys.readouterr().err


def test_a_configuration_whose_launch_file_is_missing_is_noted_and_the_others_are_looked_at(rover, capsys):
    change(rover / "roslens.toml", "rover_teleop/teleop.launch", "rover_teleop/telop.launch")
    code, answer = asked(capsys, "/scan", rover)
    assert (code, answer["cause"]) == (0, None)
    (note,) = answer["notes"]
    assert note.startswith('configuration "legacy_teleop": ')
    assert "rover_teleop/telop.launch" in note
    assert "rover_teleop/teleop.launch" in note


def test_where_no_configuration_has_its_launch_file_those_of_the_packages_are_looked_at(rover, capsys):
    (rover / "roslens.toml").write_text('[graph.configurations.gone]\nlaunch = "nowhere/gone.launch.py"\n')
    code, answer = asked(capsys, "/scan", rover)
    assert (code, answer["cause"], len(answer["notes"])) == (0, None, 1)
    assert answer["looked_at"][0].startswith("source: rover.launch.py")


def recording(folder, streams, logs=()):
    """Write messages: of each topic its seconds; of logs second, node and text, as errors. The last is at 60 s."""
    text, log = STORE.types["std_msgs/msg/String"], STORE.types["rcl_interfaces/msg/Log"]
    time = STORE.types["builtin_interfaces/msg/Time"]
    rows = [(at, topic, text("x")) for topic, times in streams.items() for at in times]
    rows += [
        (at, "/rosout", log(time(int(at), 0), 40, node, said, "file.py", "main", 1)) for at, node, said in logs
    ]  # fmt: skip
    with Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        names = dict.fromkeys(streams, "std_msgs/msg/String")
        names |= {"/rosout": "rcl_interfaces/msg/Log"} if logs else {}
        lines = {name: writer.add_connection(name, kind, typestore=STORE) for name, kind in names.items()}
        for at, topic, message in sorted(rows, key=lambda row: row[:2]):
            content = STORE.serialize_cdr(message, names[topic])
            writer.write(lines[topic], START_NS + round(at * 1e9), content)
    return folder


def every(seconds, until):
    return [number * seconds for number in range(round(until / seconds) + 1)]


def test_a_recorded_topic_that_stops_leads_to_what_it_is_made_of(rover, tmp_path, capsys):
    streams = {"/cmd_vel": every(0.1, 30), "/odom": every(0.05, 29.9), "/battery": every(1, 60)}
    bag = recording(tmp_path / "drive", streams, [(29.8, "rover_base", "motor board is gone")])
    code, answer = asked(capsys, "/cmd_vel", rover, "--launch", LAUNCH, "--bag", bag)
    assert (code, answer["cause"]["asks"]) == (1, "type")  # the recording holds texts
    sent, good = step(answer, "sent", "recording"), step(answer, "last good", "recording")
    assert "the last message came at 30.00 s, 30.0 s before the end" in sent["says"]
    assert "first to break was /odom, at 29.90 s" in good["says"]
    assert good["command"] == f"roslens why /odom --bag {bag}"
    assert "29.80 s rover_base error: motor board is gone" in good["evidence"]


def test_a_recording_alone_answers_too(tmp_path, capsys):
    bag = recording(tmp_path / "drive", {"/a": every(0.1, 20), "/b": every(0.1, 60), "/c": []})
    code, answer = asked(capsys, "/a", "--no-source", "--bag", bag)
    assert (code, answer["cause"]["asks"], answer["looked_at"]) == (1, "sent", ["recording: drive"])
    code, answer = asked(capsys, "/b", "--no-source", "--bag", bag)
    assert (code, answer["cause"]) == (0, None)
    _, answer = asked(capsys, "/c", "--no-source", "--bag", bag)
    assert "no message came in 60.0 s" in answer["cause"]["says"]


def test_what_was_not_recorded_is_no_cause(rover, tmp_path, capsys):
    bag = recording(tmp_path / "drive", {"/odom": every(0.1, 60)})
    code, answer = asked(capsys, "/scan", rover, "--launch", LAUNCH, "--bag", bag)
    assert (code, step(answer, "exists", "recording")["state"]) == (0, "cannot be seen")


def test_the_text_begins_with_the_first_cause(rover, capsys):
    assert main(["why", "/cmd_vel", str(rover), "--launch", LAUNCH, "--arg", "navigation:=false", "-q"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "topic:/cmd_vel  (source: rover_bringup/rover.launch.py navigation:=false)"
    assert lines[2].startswith("First cause: no publisher of it in")
    assert any(line.startswith("  ? running, reachable, sent, received: not in what was looked at") for line in lines)


def test_a_damaged_recording_says_what_is_not_read(tmp_path, capsys):
    folder = recording(tmp_path / "drive", {"/a": every(0.1, 60)})
    (file,) = folder.glob("*.mcap")
    content = file.read_bytes()
    file.write_bytes(content[: len(content) // 2])
    _, answer = asked(capsys, "/a", "--no-source", "--bag", file)
    assert answer["notes"]


def test_what_comes_on_events_does_not_stop(tmp_path, capsys):
    streams = {"/parameter_events": every(0.01, 1), "/events/write_split": [], "/a": every(0.1, 60)}
    bag = recording(tmp_path / "drive", streams)
    for name in ("/parameter_events", "/events/write_split"):
        code, answer = asked(capsys, name, "--no-source", "--bag", bag)
        assert (code, answer["cause"]) == (0, None)


def test_without_a_launch_file_nobody_has_to_run_together(rover, capsys):
    for path in (*rover.rglob("*.launch*"), *rover.rglob("*.test"), *rover.rglob("roslens.toml")):
        path.unlink()
    change(rover / ROVER / "rover_sensors/rover_sensors/range_filter.py", '"scan"', '"distances_of_sonars"')
    code, answer = asked(capsys, "/scan", rover)
    assert (code, answer["cause"], step(answer, "made by")["state"]) == (0, None, "cannot be seen")
