"""What shells offer for launch files and their arguments, asked as they ask."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from process_metrics.small_repository import MANIFEST, SmallRepository

from roslens.cli.completion_words import arguments, ids, launches, quantities, revisions
from roslens.cli.main import main
from roslens.model.errors import UsageError

LAUNCH = """<launch>
  <arg name="listening" default="true"/><arg name="rate" default="10"/><arg name="map" default="a/b.yaml"/>
  <arg name="must"/>
  <node pkg="talk" exec="talker"/>
</launch>"""


OFFERED = ["talk/fleet.launch.xml", "talk/more.launch.xml", "talk/robot.launch.xml", "talk/test.launch.xml"]


@pytest.fixture
def workspace(talking):
    (talking / "talk/launch/more.launch.xml").write_text(LAUNCH)
    (talking / "roslens.toml").write_text('[graph.configurations.quiet]\nlaunch = "talk/robot.launch.xml"\n')
    return talking


def test_launch_files_and_declared_configurations_are_offered(workspace):
    assert list(launches(str(workspace))) == ["quiet", *OFFERED]


def test_arguments_are_offered_with_values_that_hold_anywhere(workspace):
    assert list(arguments(str(workspace), "talk/more.launch.xml")) == [
        "listening:=true", "listening:=false", "rate:=", "rate:=10", "map:=", "must:=",
    ]  # fmt: skip
    with pytest.raises(UsageError, match="no launch file"):
        list(arguments(str(workspace), "talk/none.launch.xml"))


def test_runs_and_quantities_of_past_revisions_are_offered(tmp_path):
    made = SmallRepository(tmp_path / "r")
    made.commit("one", day=0, package_DOT_xml=MANIFEST.format("p"))
    made.git("tag", "1.0.0")
    assert list(revisions(str(made.root))) == ["now", "release", "main", "1.0.0"]
    with pytest.raises(UsageError, match="no past revisions"):
        list(quantities(str(made.root)))
    assert main(["history", str(made.root), "--every", "release", "-q"]) == 0
    assert {"loc", "findings", "revisions"} <= set(quantities(str(made.root)))


def test_what_can_be_explained_is_offered(workspace):
    assert {"his", "cyclomatic_complexity", "graph.qos"} <= set(ids(str(workspace)))


def test_no_colon_in_what_stands_for_a_value_ends_it_in_zsh(capsys):
    assert main(["completion", "zsh"]) == 0
    script = capsys.readouterr().out
    assert ":NAME\\:=VALUE:_roslens_arguments" in script
    assert ":HOST\\:PORT:" in script
    assert ":[HOST\\:]PORT:" in script


@pytest.mark.parametrize("shell", ["bash", "zsh", "tcsh"])
def test_every_shell_gets_a_script(shell, capsys):
    assert main(["completion", shell]) == 0
    assert ("_roslens_launches" in capsys.readouterr().out) == (shell != "tcsh")


@pytest.mark.timed
@pytest.mark.skipif(shutil.which("bash") is None, reason="needs bash")
@pytest.mark.parametrize(
    ("line", "offered"),
    [
        (["graph", "--launch", "ta"], OFFERED),
        (["graph", "--launch", "talk/more.launch.xml", "--arg", "li"], ["listening:=true", "listening:=false"]),
        (["graph", "--form"], ["--format"]),
        (["explain", "cycl"], ["cycle", "cyclomatic_complexity"]),
    ],
)
def test_bash_offers_them(workspace, capsys, tmp_path, line, offered):
    assert main(["completion", "bash"]) == 0
    script = tmp_path / "roslens.bash"
    script.write_text(capsys.readouterr().out)
    words = " ".join(f"'{word}'" for word in ("roslens", *line))
    asked = f'source "{script}"; COMP_WORDS=({words}); COMP_CWORD={len(line)}; _shtab_roslens; echo "${{COMPREPLY[@]}}"'
    path = os.pathsep.join((str(Path(sys.executable).parent), os.environ["PATH"]))
    reported = subprocess.run(
        [shutil.which("bash") or "bash", "--norc", "-c", asked],
        cwd=workspace,
        env={**os.environ, "PATH": path},
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert reported.stdout.split() == offered, reported.stderr
