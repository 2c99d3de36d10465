"""``roslens reference`` as a user meets it."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from roslens.cli.main import main

FIXTURES = Path(__file__).parents[2] / "fixtures" / "arni"
HEAD = "kind: reference\nname: {}\nconstraints:\n"


@pytest.fixture
def base(tmp_path: Path) -> Path:
    path = tmp_path / "base.yaml"
    path.write_text(
        HEAD.format("base") + "- {topic: /scan, id: scan, rate: 25..35 Hz, for: 2 s, text: Look at the cable.}\n"
    )
    return path


def test_check_shows_what_is_expected(base: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["reference", "check", str(base)]) == 0
    out = capsys.readouterr().out.splitlines()
    assert out[0].split() == ["of", "is", "expected", "else", "id", "stands", "in"]
    assert out[1] == f"topic /scan  rate 25..35 Hz  warning  base.scan.rate  {base}:4"
    assert out[2] == "1 constraint of 1 document"
    assert main(["reference", "check", "-q", str(base)]) == 0
    assert capsys.readouterr().out == ""


def test_a_name_without_end_does_not_flood_the_table(base: Path, capsys: pytest.CaptureFixture[str]):
    base.write_text(HEAD.format("base") + f"- {{topic: '/{'x' * 10_000}', rate: 5..6 Hz}}\n")
    assert main(["reference", "check", str(base)]) == 0
    assert max(map(len, capsys.readouterr().out.splitlines())) < 400


def test_check_names_what_is_wrong(base: Path, capsys: pytest.CaptureFixture[str]):
    base.write_text(HEAD.format("base") + "- {topic: /scan, raet: 5 Hz}\n")
    assert main(["reference", "check", str(base)]) == 2
    err = capsys.readouterr().err
    assert f"roslens: {base}:4:18: unknown key 'raet' of a constraint" in err
    assert "Did you mean 'rate'?" in err


def test_check_tells_every_contradiction(base: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    site = tmp_path / "site.yaml"
    site.write_text(HEAD.format("site") + "- {topic: '/s*', rate: <= 20 Hz}\n- {topic: '**', rate: <= 10 Hz}\n")
    assert main(["reference", "check", str(base), str(site)]) == 2
    found = capsys.readouterr()
    lines = found.err.splitlines()
    assert len(lines) == 2
    assert lines[0].startswith(f"roslens: {site}:4:18: 'site.topic.s*.rate' (topic /s*: rate <= 20 Hz) contradicts")
    assert f"'base.scan.rate' (topic /scan: rate 25..35 Hz) at {base}:4:28; both are about '/scan'" in lines[0]
    assert "3 constraints of 2 documents" in found.out


def test_explain_shows_the_sentences_and_their_places(base: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    site = tmp_path / "site.yaml"
    site.write_text(
        HEAD.format("site")
        + "- {id: scan, override: true, topic: /scan, rate: 20..30 Hz}\n- {topic: /*, rate: '>= 25 Hz'}\n"
    )
    assert main(["reference", "explain", str(base), str(site), "topic:/scan"]) == 0
    assert (
        capsys.readouterr().out
        == f"""\
topic:/scan
  1. topic /scan: rate 20..30 Hz
     base.scan.rate in {site}:4; else warning
  2. topic /*: rate >= 25 Hz
     site.topic.*.rate in {site}:5; else warning
  3. topic /scan: rate 25..35 Hz
     base.scan.rate in {base}:4; else warning, once it has lasted 2 s
     does not hold any more: replaced in {site}:4:44
     Look at the cable.
  together: rate 25..30 Hz
"""
    )
    assert main(["reference", "explain", str(base), "node:/scan"]) == 0
    assert "nothing is expected of it" in capsys.readouterr().out


def test_explain_wants_an_entity(base: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["reference", "explain", str(base), "topik:/scan"]) == 2
    assert "'topik:/scan' is not an entity; expected KIND:NAME with one of host, node" in (
        err := capsys.readouterr().err
    )
    assert "Did you mean 'topic'?" in err


def test_import_writes_a_reference_that_can_be_checked(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    target = tmp_path / "robot.yaml"
    assert main(["reference", "import", str(FIXTURES / "arni.yaml"), "-o", str(target)]) == 3
    err = capsys.readouterr().err.splitlines()
    assert err[-1] == "roslens: 8 imported, 13 changed, 14 left out"
    assert main(["reference", "check", str(target)]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "14 constraints of 1 document"
    assert main(["reference", "import", str(FIXTURES / "arni.yaml"), "-o", str(target)]) == 2
    assert "exists; expected a new file" in capsys.readouterr().err


def test_import_without_a_file_goes_to_standard_output(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    source = tmp_path / "spec.yaml"
    source.write_text("- t!/a: {frequency: [1, 2]}")
    assert main(["reference", "import", str(source)]) == 0
    assert capsys.readouterr().out == (
        "kind: reference\nname: spec\ntitle: Imported from spec.yaml\nconstraints:\n  - topic: /a\n    rate: 1..2 Hz\n"
    )


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("recorded") / "robot.bag"
    record = Path(__file__).parents[3] / "examples" / "robot" / "record.py"
    subprocess.run([sys.executable, record, path], check=True, stdout=subprocess.DEVNULL)
    return str(path)


def test_explain_says_what_was_wrong_in_a_recording_and_why(
    base: Path, recorded: str, capsys: pytest.CaptureFixture[str]
):
    base.write_text(HEAD.format("base") + "- {topic: /cmd_vel, id: drive, rate: '>= 15 Hz'}\n")
    assert main(["reference", "explain", str(base), "topic:/cmd_vel", "--bag", recorded]) == 0
    out = capsys.readouterr().out
    assert re.search(r"in the recording:\n +60\.\d\d s  base\.drive\.rate is low: ", out)
    assert "               it is a first cause\n" in out
    assert main(["reference", "explain", str(base), "topic:/odom", "--bag", recorded]) == 0
    assert capsys.readouterr().out.endswith("in the recording:\n  nothing was wrong with it\n")


def test_explain_for_programs(base: Path, recorded: str, capsys: pytest.CaptureFixture[str]):
    base.write_text(HEAD.format("base") + "- {topic: /cmd_vel, id: drive, rate: '>= 15 Hz'}\n")
    assert main(["reference", "explain", str(base), "topic:/cmd_vel", "--json"]) == 0
    explained = json.loads(capsys.readouterr().out)
    assert [one["id"] for one in explained["constraints"]] == ["base.drive.rate"]
    assert "wrong" not in explained
    assert main(["reference", "explain", str(base), "topic:/cmd_vel", "--bag", recorded, "--json"]) == 0
    (wrong,) = json.loads(capsys.readouterr().out)["wrong"]
    assert (wrong["state"], wrong["first_cause"], round(wrong["at"])) == ("low", True, 60)


def test_check_lists_reactions_and_refuses_actions_on_what_is_not_in_a_graph(
    base: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    base.write_text(
        "kind: reference\nname: base\nreactions:\n"
        "- {id: lidar, when: {node: /lidar, is: gone}, do: [{notify: gone}, {restart: /lidar}]}\n"
    )
    assert main(["reference", "check", str(base)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-2].split() == ["base.lidar", "notify", "→", "restart", f"{base}:4:3"]
    assert lines[-1] == "1 reaction"
    graph = tmp_path / "graph.yaml"
    graph.write_text("nodes:\n- name: /lidar\n")
    assert main(["reference", "check", "-q", str(base), "--graph", str(graph)]) == 0
    graph.write_text("nodes:\n- name: /lidar_driver\n")
    assert main(["reference", "check", "-q", str(base), "--graph", str(graph)]) == 2
    assert f"roslens: {base}:4:69: `restart` of '/lidar'; expected a node that is there" in capsys.readouterr().err
