"""With `--no-store --no-cache` nothing below the workspace is made, changed or touched, whatever the verb."""

from __future__ import annotations

import os
import subprocess

import pytest

from roslens.cli.main import main, parser
from roslens.cli.terminal.streams import NoProgress
from roslens.dashboard.export import export_folder

PLUGIN = """\
from roslens.plugins.points import Manifest

manifest = Manifest(name="near", interface="1.0", version="1.0", scopes=("workspace",))


def analyse_workspace(workspace, report):
    import subprocess, sys
    from .later import WORD

    subprocess.run([sys.executable, "-c", "import near_too"], cwd=__path__[0], check=True)
"""
CONFIGURATION = '[graph.configurations.robot]\nlaunch = "talk/robot.launch.xml"\n'
KEEPING_NOTHING = ("--no-store", "--no-cache")
CASES = {
    "check": ["check"],
    "check with graphs": ["check", "--graph", "--format", "json"],
    "graph": ["graph"],
    "graph of a launch file": ["graph", "--launch", "talk/robot.launch.xml", "--check", "--fail-on", "never"],
    "graph drawn": ["graph", "--launch", "talk/robot.launch.xml", "--html", "{out}/graph.html"],
    "graphs of two revisions": ["graph", "--launch", "talk/robot.launch.xml", "--diff", "HEAD", "."],
    "report": ["report", "-o", "{out}/report"],
    "report of one file": ["report", "--single-file", "{out}/report.html", "--no-graph"],
    "serve": ["serve"],
}


@pytest.fixture
def workspace(talking, tmp_path, monkeypatch):
    """A repository with plug-ins in it, whose index is older than its files."""
    near = talking / "tools" / "near"
    near.mkdir(parents=True)
    (near / "__init__.py").write_text(PLUGIN)
    for name in ("later", "near_too"):
        (near / f"{name}.py").write_text("WORD = 1\n")
    (talking / "roslens.toml").write_text('plugins = ["tools/near"]\n' + CONFIGURATION)
    git = ["git", "-C", str(talking), "-c", "user.name=a", "-c", "user.email=a@example.org"]
    for words in (["init", "-q"], ["add", "-A"], ["commit", "-q", "-m", "all"]):
        subprocess.run([*git, *words], check=True)
    for path in talking.rglob("*"):
        if path.is_file() and ".git" not in path.parts:
            os.utime(path, (1_700_000_000, 1_700_000_000))
    main(["trust", str(talking)])
    monkeypatch.delenv("PYTHONDONTWRITEBYTECODE", raising=False)
    monkeypatch.delenv("PYTHONPYCACHEPREFIX", raising=False)
    return talking


def state(folder):
    found = {}
    for path in (folder, *folder.rglob("*")):
        is_now = path.lstat()
        found[str(path.relative_to(folder))] = (is_now.st_ino, is_now.st_size, is_now.st_mtime_ns, is_now.st_ctime_ns)
    return found


@pytest.mark.parametrize("words", CASES.values(), ids=CASES)
def test_nothing_is_written(workspace, tmp_path_factory, monkeypatch, capsys, words):
    out = tmp_path_factory.mktemp("out")
    served = []

    def serve(site, **_):
        served.append(site)
        export_folder(site, out / "served", NoProgress(), 1)

    monkeypatch.setattr("roslens.dashboard.server.serve", serve)
    verb, *rest = (word.format(out=out) for word in words)
    before = state(workspace)
    code = main([verb, str(workspace), *rest, *KEEPING_NOTHING])
    assert state(workspace) == before
    assert code in (0, 1, 3), capsys.readouterr().err
    assert bool(served) == (verb == "serve")
    if verb in ("report", "serve"):
        assert [*out.iterdir()]


def test_every_verb_that_can_keep_something_is_asked():
    (verbs,) = (action for action in parser()._actions if isinstance(action.choices, dict))
    keeping = {
        verb: [option for option in KEEPING_NOTHING if option in one._option_string_actions]
        for verb, one in verbs.choices.items()
    }
    asked = {words[0] for words in CASES.values()}
    assert {verb for verb, options in keeping.items() if options} == asked | {"compare", "interfaces", "port", "why"}
    assert all(len(keeping[verb]) == len(KEEPING_NOTHING) for verb in asked), "who takes one takes both"
    for verb in ("compare", "interfaces", "port", "why"):
        assert keeping[verb] == ["--no-cache"], "they keep no runs"


def test_a_list_of_interfaces_writes_nothing(workspace):
    before = state(workspace)
    assert main(["interfaces", str(workspace), "--since", "HEAD", "--no-cache"]) == 0
    assert state(workspace) == before


def test_a_port_that_is_shown_writes_nothing(workspace):
    before = state(workspace)
    assert main(["port", "humble", "lyrical", str(workspace), "--no-cache"]) in (0, 1)
    assert state(workspace) == before


def test_a_comparison_writes_nothing(workspace, tmp_path, capsys):
    reference = tmp_path / "robot.yaml"
    reference.write_text("kind: reference\nname: r\nconstraints:\n  - {topic: /chatter, rate: '>= 1 Hz'}\n")
    before = state(workspace)
    words = ["--launch", "talk/robot.launch.xml", "--workspace", str(workspace), "--no-cache"]
    code = main(["compare", str(workspace), str(reference), *words])
    assert state(workspace) == before
    assert code in (0, 1), capsys.readouterr().err


def test_a_run_by_its_number_is_one_that_was_kept(workspace, capsys):
    assert main(["report", str(workspace), "--no-store", "--run", "1"]) == 2
    assert "--run 1 with --no-store" in capsys.readouterr().err
