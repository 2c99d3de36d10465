"""Plug-ins, too, run in a sandbox: they read the workspace and write their own scratch, and that is all."""

import json
import os
import sys
from pathlib import Path

import pytest

from roslens.children.landlock import landlock_version
from roslens.children.no_sockets import can_refuse_sockets
from roslens.children.plugin_sandbox import SWITCH, plugin_sandbox
from roslens.cli.main import main

pytestmark = pytest.mark.skipif(not landlock_version(), reason="this kernel has no Landlock")

MANIFEST = '<package format="3"><name>a</name><version>1.0.0</version><description>d</description>\
<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>'

PLUGIN = """
import os, socket, subprocess, sys, tempfile
from pathlib import Path
from roslens.plugins.points import Manifest, RuleInfo

HERE = Path(__file__).parent
WORDS = (HERE / "words.txt").read_text()
manifest = Manifest(
    name="own", interface="1.0", version="1", text="t", scopes=("package", "workspace"),
    rules=(RuleInfo(id="own.tried", title="t", description="d"),),
)

def tried(what):
    try:
        return what() or "yes"
    except OSError as error:
        return type(error).__name__

def started(*words):
    return subprocess.run(words, capture_output=True, text=True).stdout.strip()

def analyse_package(package, report):
    of_name = {{Path(file.path).name: Path(file.absolute) for file in package.files}}
    if "a.py" not in of_name:
        return
    root = of_name["a.py"].parents[1]
    home = Path({home!r})
    for name, what in {{
        "words": lambda: WORDS,
        "reads": lambda: of_name["a.py"].read_text()[:1],
        "linked": lambda: of_name["linked.py"].read_text()[:1],
        "changes": lambda: of_name["a.py"].write_text("x"),
        "adds": lambda: (root / "new").write_text("x"),
        "home": lambda: (home / "key").read_text(),
        "list": lambda: str(list(home.iterdir())),
        "net": lambda: str(socket.socket(socket.AF_INET)),
        "scratch": lambda: Path(tempfile.mkstemp()[1]).write_text("x"),
        "own home": lambda: (Path.home() / "kept").write_text("x"),
        "system": lambda: started("git", "--version")[:3],
        "python": lambda: started(sys.executable, "-c", "print(1)"),
        "of workspace": lambda: started(str(root / "tool.sh")),
        "of plug-in": lambda: started(str(HERE / "tool.sh")),
        "signal": lambda: os.kill({pid}, 0),
    }}.items():
        report.finding("own.tried", f"{{name}}: {{tried(what)}}")

def analyse_workspace(workspace, report):
    Path(workspace.scratch, "x").write_text("x")
    Path(workspace.artifacts, "kept.txt").write_text("kept")
"""


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """A trusted workspace with a plug-in, and a home that is not its business."""
    home, root = tmp_path / "home", tmp_path / "ws"
    for place in (home, root / "a", root / "checks" / "own", tmp_path / "elsewhere"):
        place.mkdir(parents=True)
    (home / "key").write_text("secret")
    (root / "a" / "package.xml").write_text(MANIFEST)
    (root / "a" / "a.py").write_text("x = 1\n")
    (tmp_path / "elsewhere" / "linked.py").write_text("y = 1\n")
    (root / "a" / "linked.py").symlink_to(tmp_path / "elsewhere" / "linked.py")
    (root / "checks" / "own" / "__init__.py").write_text(PLUGIN.format(home=str(home), pid=os.getpid()))
    (root / "checks" / "own" / "words.txt").write_text("its words")
    for place in (root, root / "checks" / "own"):
        (place / "tool.sh").write_text("#!/bin/sh\necho ran\n")
        (place / "tool.sh").chmod(0o755)
    (root / "roslens.toml").write_text("plugins = ['checks/own']\n")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "user"))
    return root


def tried(root, capfd):
    main(["check", str(root), "--trust", "--jobs", "1", "--format", "json", "--fail-on", "never"])
    report = json.loads(capfd.readouterr().out)
    assert report["failures"] == []
    found = [one["message"].split(": ", 1) for one in report["findings"] if one["rule"] == "own.tried"]
    return dict(found)


def test_what_a_plug_in_may_do(workspace, capfd):
    found = tried(workspace, capfd)
    refused = {name for name, answer in found.items() if answer == "PermissionError"}
    net = {"net"} if can_refuse_sockets() else set()
    signals = {"signal"} if landlock_version() >= 6 else set()
    assert refused == {"changes", "adds", "home", "list", "of workspace"} | net | signals
    assert found["words"] == "its words"
    assert (found["reads"], found["linked"], found["system"]) == ("x", "y", "git")
    assert (found["python"], found["of plug-in"]) == ("1", "ran")
    assert (found["scratch"], found["own home"]) == ("1", "1")
    assert (workspace / "a" / "a.py").read_text() == "x = 1\n"
    assert (workspace / ".roslens" / "artifacts" / "kept.txt").read_text() == "kept"


def test_the_user_may_switch_it_off(workspace, capfd, monkeypatch):
    monkeypatch.setenv(SWITCH, "off")
    found = tried(workspace, capfd)
    assert (found["home"], found["of workspace"], found["adds"]) == ("secret", "ran", "1")


def test_folders_that_hold_the_workspace_are_read_and_nothing_in_them_started(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "path", [*sys.path, str(tmp_path)])
    root = tmp_path / "ws"
    environment = {"PATH": os.pathsep.join((str(tmp_path), str(root / "bin"), "relative", "/usr/bin"))}
    found = plugin_sandbox([str(root)], [str(root / "one.py")], [str(tmp_path / "out")], environment)
    assert found.read == (str(root), str(tmp_path))
    assert "/usr" in found.run
    assert not {str(tmp_path), str(root / "bin"), "relative"} & {*found.run}
    assert found.write == (str(tmp_path / "out"),)


def test_a_project_that_is_edited_where_it_stands_is_found(tmp_path, monkeypatch):
    site = tmp_path / "site" / "edited-1.dist-info"
    site.mkdir(parents=True)
    (site / "METADATA").write_text("Name: edited\nVersion: 1\n")
    project = tmp_path / "a project"
    (site / "direct_url.json").write_text(json.dumps({"url": project.as_uri(), "dir_info": {"editable": True}}))
    monkeypatch.setattr(sys, "path", [*sys.path, str(Path(site).parent)])
    assert str(project) in plugin_sandbox([str(tmp_path / "ws")], [], [], {}).run


def test_the_doctor_says_so(workspace, capsys, monkeypatch):
    main(["doctor", str(workspace)])
    assert "sandbox of tools and plug-ins: Landlock" in capsys.readouterr().out
    monkeypatch.setenv(SWITCH, "off")
    main(["doctor", str(workspace)])
    assert "plug-ins run without one ($ROSLENS_PLUGIN_SANDBOX is off)" in capsys.readouterr().out
