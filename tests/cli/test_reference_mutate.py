"""``roslens reference mutate`` as a user meets it, on the recording of the example."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from roslens.cli.main import main

ROBOT = Path(__file__).parents[2] / "examples" / "robot"


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("bag") / "robot.bag"
    subprocess.run([sys.executable, ROBOT / "record.py", path], check=True, stdout=subprocess.DEVNULL)
    return str(path)


@pytest.fixture
def reference(tmp_path):
    path = tmp_path / "r.yaml"
    path.write_text(
        "kind: reference\nname: r\ndefaults: {grace: 2 s}\nconstraints: [{topic: /odom, rate: '>= 35 Hz'}]\n"
    )
    return str(path)


def test_a_table_of_what_is_seen(bag, reference, capsys):
    assert main(["reference", "mutate", reference, "--bag", bag, "--topic", "/odom", "--time", "4s", "-q"]) == 0
    out = capsys.readouterr().out
    assert out.splitlines()[0].split("  ")[0] == "topic"
    assert " faults are seen (" in out
    assert "  /odom: wrong value (no constraint is about its fields)" in out


def test_for_programs_and_ci(bag, reference, capsys):
    arguments = [
        "reference",
        "mutate",
        reference,
        "--bag",
        bag,
        "--topic",
        "/{odom,scan}",
        "--time",
        "5s",
        "-q",
        "--json",
    ]
    assert main([*arguments, "--at-least", "99"]) == 1
    result = json.loads(capsys.readouterr().out)
    assert result["version"] == 1
    assert result["topics"]["/scan"]["dead publisher"]["seen"] == 0
    assert result["topics"]["/odom"]["rate halved"]["seen"] >= 1
    assert 0 < result["share"] < 99


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (["--time", "soon"], "--time: 'soon' is not an amount"),
        (["--at-least", "120"], "--at-least 120; expected a share from 0 to 100"),
        (["--topic", "/none"], "no topic to put faults into"),
        (["--topic", "re:("], "--topic: "),
    ],
)
def test_what_cannot_be_is_named(bag, reference, more, said, capsys):
    assert main(["reference", "mutate", reference, "--bag", bag, *more]) == 2
    assert said in capsys.readouterr().err


def test_a_recording_that_is_too_short(bag, tmp_path, capsys):
    path = tmp_path / "r.yaml"
    path.write_text("kind: reference\nname: r\nconstraints: [{topic: /odom, rate: 5 Hz ± 1 Hz, window: 60 s}]\n")
    assert main(["reference", "mutate", str(path), "--bag", bag]) == 2
    assert "a recording of 80.0 s; expected at least 150 s" in capsys.readouterr().err


def test_a_node_that_vanishes_is_seen_by_who_expects_it(bag, tmp_path, capsys):
    path = tmp_path / "nodes.yaml"
    path.write_text(
        "kind: reference\nname: r\ndefaults: {grace: 2 s}\nconstraints: [{node: /odometry, expected: always}]\n"
    )
    words = ["reference", "mutate", str(path), "--bag", bag, "--topic", "/{odom,scan}", "--time", "3s", "-q", "--json"]
    assert main(words) == 0
    topics = json.loads(capsys.readouterr().out)["topics"]
    assert topics["/odom"]["vanished node"]["seen"] == topics["/odom"]["vanished node"]["tried"] > 0
    assert topics["/odom"]["dead publisher"]["seen"] == 0
    assert topics["/scan"]["vanished node"]["seen"] == 0
