"""`roslens watch` and `roslens reference draft | test` over the recording of the example."""

import json
import platform
import subprocess
import sys
from pathlib import Path

import pytest

from roslens.cli.main import main
from roslens.store.live.history import History

ROBOT = Path(__file__).parents[2] / "examples" / "robot"
ROVER = str(ROBOT / "rover.yaml")


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("bag") / "robot.bag"
    subprocess.run([sys.executable, ROBOT / "record.py", path], check=True, stdout=subprocess.DEVNULL)
    return str(path)


def test_the_faults_of_the_recording_are_told_with_when_they_began(bag, capsys):
    assert main(["watch", "--bag", bag, "--reference", ROVER, "--no-color"]) == 1
    lines = capsys.readouterr().out.splitlines()
    reported = [(float(line.split()[0]), line.split()[3], line.split()[4]) for line in lines if " s " in line[:14]]
    assert ("low", "topic:/scan") in [(state, entity) for at, state, entity in reported if 29.5 <= at <= 31]
    assert ("high", "topic:/odom") in [(state, entity) for at, state, entity in reported if 44.5 <= at <= 46]
    assert ("absent", "topic:/cmd_vel") in [(state, entity) for at, state, entity in reported if 59.5 <= at <= 61]
    entities = {entity for at, _, entity in reported if at < 59}
    assert entities <= {"topic:/scan", "topic:/odom", "topic:/planner/status"}
    (over,) = [line for line in lines if "topic:/scan  rate" in line and "again, after" in line]
    assert 5 < float(over.rpartition("after ")[2].removesuffix(" s")) < 15
    assert "7,099 messages in 80.0 s" in "\n".join(lines)
    assert " alarms were raised; " in lines[-1]


def test_lines_of_json(bag, capsys):
    assert main(["watch", "--bag", bag, "--reference", ROVER, "--format", "json"]) == 1
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert {line["is"] for line in lines} == {"verdict"}
    scan = [line for line in lines if line["entity"] == "topic:/scan" and line["quantity"] == "rate"]
    assert [line["state"] for line in scan] == ["ok", "low", "ok"]
    assert scan[1]["expectation"] == "rover.topic.scan.rate"
    assert scan[1]["where"].startswith(f"{ROVER}:")
    assert 29 <= scan[1]["since_at"] <= scan[1]["at"] <= 32
    assert scan[2]["lasted"] == pytest.approx(scan[2]["since"] - scan[1]["since"])
    assert "lasted" not in scan[1]


def test_what_fails_is_chosen(bag, capsys):
    assert main(["watch", "--bag", bag, "--reference", ROVER, "-q", "--fail-on", "never"]) == 0
    assert main(["watch", "--bag", bag]) == 0
    assert "Nothing was judged. `roslens reference draft" in capsys.readouterr().out


def test_a_file_takes_the_result(bag, tmp_path, capsys):
    out = tmp_path / "out.txt"
    assert main(["watch", "--bag", bag, "--reference", ROVER, "-o", str(out)]) == 1
    assert capsys.readouterr().out == ""
    assert "topic:/scan" in out.read_text()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--bag", "none.bag"], "none.bag"),
        (["--bag", __file__], "begins with"),
        (["--fail-on", "hihg", "--bag", "x"], "--fail-on 'hihg'; expected low, high, absent, unknown or never"),
        (["--bag", "x", "--for", "5 s"], "--for with --bag; expected one of them"),
        (["--bag", "x", "--prometheus", "1"], "--prometheus with --bag"),
        (["--reference", "none.yaml"], "none.yaml: cannot read it"),
        (["--for", "5 Hz"], "--for '5 Hz'"),
        (["--listen", "127.0.0.1:0"], "--listen without a key; expected --key-file FILE"),
    ],
)
def test_what_makes_no_sense_is_said(words, said, capsys):
    assert main(["watch", *words]) == 2
    assert said in capsys.readouterr().err


def test_this_host_for_a_moment_where_no_ros_is(tmp_path, capsys, monkeypatch):
    for name in ("ROS_MASTER_URI", "ROSLENS_ROS2_PYTHON"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("roslens.live.adapters.child._unfit", lambda *_: "No module named 'rclpy'")
    history = tmp_path / "live.sqlite"
    words = ["watch", "--for", "1.5 s", "--history", str(history), "--format", "json"]
    assert main(words) == 3
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    (line,) = [line for line in lines if line["is"] == "failure"]
    assert line["what"].startswith("no ROS was found: no $ROS_MASTER_URI and no Python with rclpy")
    with History.open(history) as kept:
        assert kept.points(f"host:{platform.node()}", "memory", 0, 4e9, most=10**9)


def test_a_draft_raises_nothing_on_what_is_steady_and_finds_the_faults(bag, tmp_path, capsys):
    draft = tmp_path / "draft.yaml"
    assert main(["reference", "draft", "--bag", bag, "-o", str(draft)]) == 0
    assert main(["reference", "draft", "--bag", bag, "-o", str(draft)]) == 2
    _, _, listed = draft.read_text("utf-8").partition("# On what it was drafted from it raises:\n")
    capsys.readouterr()
    assert main(["reference", "test", str(draft), "--bag", bag]) == 1
    reported = capsys.readouterr().out.splitlines()
    gaps = [line for line in reported if "/odom" in line and "gap is high" in line]
    assert len(gaps) == 1
    assert 44.5 <= float(gaps[0].split()[0]) <= 46
    # What the draft lists is what the test of it raises.
    raised = [line.removeprefix("#").strip() for line in listed.splitlines() if line.startswith("#  ")]
    assert [" ".join(line.split()) for line in raised] == [" ".join(line.split()) for line in reported[:-1]]


def test_a_test_with_expectations(bag, tmp_path, capsys):
    expect = tmp_path / "alarms.yaml"
    expect.write_text(
        "kind: reference test\nothers: allowed\nalarms:\n"
        "  - {entity: 'topic:/scan', quantity: rate, state: low, at: 30.5 s, within: 1 s}\n"
        "  - {entity: 'topic:/cmd_vel', state: absent, at: 60 s, within: 1 s}\n"
    )
    assert main(["reference", "test", ROVER, "--bag", bag, "--expect", str(expect)]) == 0
    assert "as expected" in capsys.readouterr().out
    expect.write_text("kind: reference test\nothers: allowed\nalarms:\n  - {entity: 'topic:/scan', at: 10 s}\n")
    assert main(["reference", "test", ROVER, "--bag", bag, "--expect", str(expect)]) == 1
    assert f"{expect}:4: not raised: topic:/scan at 10 s (within 0.5 s)" in capsys.readouterr().err


SCAM = (
    "kind: reference\nname: r\nconstraints:\n  - {topic: '/scam*', rate: 1..2 Hz}\n"
    "  - {topic: /odom, type: nav_msgs/Path, rate: 1..2 Hz}\n  - {node: /nobody*, cpu: <= 5 %}\n"
)
ABOUT_NOTHING = [
    "r.topic.odom.rate matches nothing: no topic /odom of type {} exists. /odom is there, but of type {}".format(
        "nav_msgs/Path", "sensor_msgs/Imu"
    ),
    "r.topic.scam*.rate matches nothing: no topic /scam* exists. Did you mean '/scan'?",
]


def test_what_is_about_nothing_is_told_at_the_end(bag, tmp_path, capsys):
    scam = tmp_path / "r.yaml"
    scam.write_text(SCAM)
    reported = [f"{scam}:{line}: {text}" for line, text in zip((5, 4), ABOUT_NOTHING, strict=True)]
    main(["watch", "--bag", bag, "--reference", str(scam), "--no-color"])
    out = capsys.readouterr().out.splitlines()
    assert out[-5:-2] == ["2 constraints match nothing that was seen:", *(f"  {one}" for one in reported)]
    main(["watch", "--bag", bag, "--reference", str(scam), "--format", "json"])
    lines = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [line["text"] for line in lines if line["is"] == "note"] == reported
    main(["reference", "test", str(scam), "--bag", bag])
    assert capsys.readouterr().err.splitlines() == [f"roslens: {one}" for one in reported]
    assert main(["reference", "check", str(scam), "--bag", bag]) == 0
    assert capsys.readouterr().err.splitlines() == [f"roslens: {one}" for one in reported]


def test_the_graph_goes_into_a_file(bag, tmp_path, capsys):
    out = tmp_path / "graph.yaml"
    assert main(["watch", "--bag", bag, "-q", "--graph-out", str(out)]) == 0
    text = out.read_text()
    assert 'name: "/scan"' in text
    assert main(["watch", "--bag", bag, "-q", "--graph-out", "/proc/none/graph.yaml"]) == 2
    assert "--graph-out '/proc/none/graph.yaml'" in capsys.readouterr().err


def test_a_draft_from_the_graph_of_a_watch(bag, tmp_path, capsys):
    graph, draft = tmp_path / "graph.yaml", tmp_path / "draft.yaml"
    assert main(["watch", "--bag", bag, "-q", "--graph-out", str(graph)]) == 0
    assert main(["reference", "draft", "--graph", str(graph), "-o", str(draft)]) == 0
    assert main(["reference", "test", str(draft), "--bag", bag]) == 0
    assert "no alarm in 80.0 s" in capsys.readouterr().out
    graph.write_text("nodes:\n- naem: x\n")
    assert main(["reference", "draft", "--graph", str(graph)]) == 2
    assert f"{graph}:2:3: unknown key 'naem' of a node" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--bag", "x", "--tap", "/a"], "--tap without --live; expected one of them"),
        (["--live", "5 Hz"], "--live '5 Hz'"),
        (["--live", "-5 s"], "--live '-5 s'; expected a time above 0"),
        (["--graph", "none.yaml"], "none.yaml: cannot read it"),
        (["--live", "5 s", "--listen", "127.0.0.1:0"], "--listen without a key"),
    ],
)
def test_what_cannot_be_drafted_from_is_said(words, said, capsys):
    assert main(["reference", "draft", *words]) == 2
    assert said in capsys.readouterr().err


def test_a_draft_of_what_runs_where_no_ros_is(tmp_path, capsys, monkeypatch):
    for name in ("ROS_MASTER_URI", "ROSLENS_ROS2_PYTHON"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("roslens.live.adapters.child._unfit", lambda *_: "No module named 'rclpy'")
    assert main(["reference", "draft", "--live", "1 s"]) == 3
    found = capsys.readouterr()
    assert "constraints: []" in found.out
    assert "no ROS was found: no $ROS_MASTER_URI" in found.err


def test_shells_complete_the_new_options(capsys):
    assert main(["completion", "bash"]) == 0
    script = capsys.readouterr().out
    assert all(option in script for option in ("--graph-out", "--live", "--graph"))


@pytest.fixture
def no_ros(monkeypatch):
    for name in ("ROS_MASTER_URI", "ROSLENS_ROS2_PYTHON"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setattr("roslens.live.adapters.child._unfit", lambda *_: "No module named 'rclpy'")


def test_a_file_takes_the_result_of_what_runs(no_ros, tmp_path, capsys):
    out = tmp_path / "out.txt"
    assert main(["watch", "--for", "1 s", "-o", str(out)]) == 3
    assert platform.node() in out.read_text()
    assert capsys.readouterr().out == ""


def test_a_screen_ends_with_the_exit_code_and_the_words_of_what_it_showed(no_ros, tmp_path, capfd, monkeypatch):
    reference = tmp_path / "r.yaml"
    reference.write_text(
        "kind: reference\nname: r\ndefaults: {grace: 0 s}\nconstraints:\n"
        f"  - {{host: {platform.node()}, memory: <= 1 MB}}\n"
    )
    monkeypatch.setattr("sys.stdout.isatty", lambda: True, raising=False)
    assert main(["watch", "--for", "2.5 s", "--reference", str(reference)]) == 1
    found = capfd.readouterr()
    assert "\x1b[?1049l" in found.out
    assert "1 alarm was raised; " in found.out
    assert "roslens: no ROS was found" in found.err
