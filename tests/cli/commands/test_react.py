"""``roslens react --simulate`` and time lines of ``roslens reference test`` as a user meets them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from roslens.cli.main import main
from roslens.judge.pages.reactions_page import EXAMPLE, TIME_LINE


@pytest.fixture
def front(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("front.yaml").write_text(EXAMPLE)
    Path("front.test.yaml").write_text(TIME_LINE)
    return "front.yaml"


def test_what_would_have_been_done_when_and_why(front, capsys):
    assert main(["react", "--simulate", front, "--timeline", "front.test.yaml"]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "    21.50 s  front.blind/1.0: publish"
    assert "             because topic:/scan is absent since 21.00 s: given" in lines
    assert "             first cause node:/lidar" in lines
    assert "    22.10 s  front.lidar/2.1: restart node:/lidar: /lidar on robot-1 is crashed" in lines
    assert "    32.10 s  front.lidar/2.1: still there: the next action follows" in lines
    assert lines[-1] == "front.test.yaml: 4 actions in 40.0 s; nothing was done"


def test_for_programs(front, capsys):
    assert main(["react", "--simulate", front, "--timeline", "front.test.yaml", "--json"]) == 1
    (run,) = json.loads(capsys.readouterr().out)["simulated"]
    assert [one["action"]["kind"] for one in run["decisions"]] == ["publish", "notify", "restart", "publish"]
    assert run["checks"][0]["verification"] == "still there"


def test_why_nothing_is_done(front, capsys):
    Path("front.yaml").write_text(EXAMPLE.replace("at_most: 5 per h", "at_most: 1 per h"))
    assert main(["react", "--simulate", front, "--timeline", "front.test.yaml"]) == 1
    assert "front.lidar of the system: not done: at most 1 in 3600 s" in capsys.readouterr().out


def test_time_lines_beside_a_reference_are_run(front, capsys):
    assert main(["reference", "test", front]) == 0
    assert capsys.readouterr().out == "front.test.yaml: front.test.yaml: as expected\n1 time line, as expected\n"


def test_a_time_line_that_is_not_as_expected(front, capsys):
    Path("night.yaml").write_text(TIME_LINE.replace("{at: 32 s, reaction", "{at: 35 s, reaction"))
    assert main(["reference", "test", front, "--timeline", "night.yaml"]) == 1
    found = capsys.readouterr()
    assert found.out.endswith("1 time line, 1 of them not as expected\n")
    assert "roslens: night.yaml:13:5: not decided: front.lidar publish at 35 s (within 0.5 s)\n" in found.err
    assert "roslens: not expected:\n    32.10 s  front.lidar/2.2: publish" in found.err


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["react", "--simulate", "front.yaml"], "--simulate without --bag and without --timeline"),
        (["react", "front.yaml", "--timeline", "front.test.yaml"], "--timeline without --simulate"),
        (["react"], "nothing to react to"),
        (["react", "--simulate", "bare.yaml", "--timeline", "front.test.yaml"], "no reaction in bare.yaml"),
        (["react", "--simulate", "front.yaml", "--timeline", "none.yaml"], "none.yaml: cannot read it"),
        (["reference", "test", "bare.yaml"], "neither a recording nor a time line; expected --bag"),
        (["reference", "test", "bare.yaml", "--timeline", "front.test.yaml"], "no reaction in bare.yaml"),
        (["reference", "test", "front.yaml", "--expect", "x.yaml"], "--expect without --bag"),
    ],
)  # fmt: skip
def test_what_is_missing_is_named(front, arguments, said, capsys):
    Path("bare.yaml").write_text("kind: reference\nname: bare\n")
    assert main(arguments) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{}", "1:1: a time line in which nothing is given"),
        ("given: [{at: 1 s}]", "1:9: 0 entities in a line of `given`"),
        ("given: [{node: /a}]", "nothing said of node:/a"),
        ("given: [{node: /a, is: gonne}]", "1:24: is is 'gonne'"),
        ("given: [{node: /a, lifecycle: on}]", "lifecycle is 'on'"),
        ("given: [{node: /a, value: 1}]", "'value' of node:/a; expected it of a parameter"),
        ("given: [{node: /a, is: gone, number: x}]", "number: could not convert"),
        ("given: [{node: /a, is: gone, at: 10}]\nuntil: 5", "2:8: the time line ends at 5 s"),
        ("given: [{node: /a, is: gone}]\nuntil: 5 d", "the time line ends at 432000 s"),
        ("given: [{node: /a, is: gone}]\nexpect: [{at: 1, action: explode}]", "2:26: action is 'explode'"),
        ("given: [{node: /a, is: gone}]\nexpect: [{at: 1, entity: a}]", "entity: 'a' is not an entity id"),
        ("given: [{node: /a, is: gone}]\ndone: {restart: yes}", "restart is 'yes'; expected one of done, refused"),
        ("tests: []\ngiven: []", "'tests' beside a time line"),
    ],
)
def test_what_is_wrong_with_a_time_line(front, text, said, capsys):
    Path("bad.yaml").write_text(text)
    assert main(["react", "--simulate", front, "--timeline", "bad.yaml"]) == 2
    assert f"roslens: bad.yaml:{said}" in (err := capsys.readouterr().err) or said in err
