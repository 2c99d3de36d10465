"""The plug-in of rqt: what it reads of a monitor, and in a Python with Qt what it shows."""

import json
import os
import subprocess
import sys
import threading
from pathlib import Path
from xml.etree.ElementTree import parse

import pytest
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.dashboard.live.serving import LivePage
from roslens.dashboard.live.snapshot import UNJUDGED, VERSION
from roslens.model.verdict import State

PACKAGE = Path(__file__).parents[2] / "ros/rqt_roslens"
SOURCE = PACKAGE / "src"


@pytest.fixture
def part(monkeypatch):
    """Return what imports a part of the package that needs no Qt."""
    from importlib import import_module

    monkeypatch.syspath_prepend(str(SOURCE))
    yield lambda name: import_module(f"rqt_roslens.{name}")
    for name in [name for name in sys.modules if name.startswith("rqt_roslens")]:
        del sys.modules[name]


@pytest.fixture
def robot():
    made = ScriptedRobot()
    made.rates["/scan"] = 4
    made.run(5)
    return made


def test_it_knows_every_state_and_the_version_of_snapshots(part):
    assert set(part("words").SIGNS) == {UNJUDGED, *(state.value for state in State)}
    assert part("monitor").VERSION == VERSION


def test_rqt_finds_the_class_that_the_package_has(part):
    [entry] = parse(PACKAGE / "plugin.xml").getroot()
    module, _, name = entry.get("type").rpartition(".")
    source = (SOURCE / f"{module.replace('.', '/')}.py").read_text()
    assert f"class {name}(Plugin)" in source
    assert entry.get("base_class_type") == "rqt_gui_py::Plugin"
    exported = parse(PACKAGE / "package.xml").getroot().find("export/rqt_gui")
    assert exported.get("plugin") == "${prefix}/plugin.xml"


def test_alerts_and_the_first_line_are_told_in_words(part, robot):
    words = part("words")
    snapshot = json.loads(robot.page.newest())
    [(entity, state, text)] = words.alert_rows(snapshot["alerts"])
    assert (entity, state) == ("topic:/scan", "low")
    assert "/scan: rate is low: 4 Hz" in text
    assert "1 low" in words.head(snapshot, "")
    assert words.head(snapshot, "no answer: refused").startswith("NOT CURRENT: no answer")
    assert words.clean("/a\x1b[31m\u202eb") == "/a [31m b"


def test_values_are_kept_for_plots_and_forgotten_with_their_rows(part, robot):
    past = part("monitor").Past()
    snapshot = json.loads(robot.page.newest())
    past.take(snapshot)
    past.take(snapshot)
    past.take({**snapshot, "time": snapshot["time"] + 1})
    assert past.series("topic:/scan", "rate") == [4.0, 4.0]
    past.take({**snapshot, "time": snapshot["time"] + 2, "rows": []})
    assert past.series("topic:/scan", "rate") == []


@pytest.mark.timed
def test_a_monitor_is_asked_and_its_absence_told(part, robot):
    monitor = part("monitor")
    came, reported = threading.Event(), []

    def take(*look):
        reported.append(look)
        came.set()

    with LivePage(robot.page.newest, detail=robot.page.detail) as page:
        watcher = monitor.Watcher(take)
        watcher.choose("topic:/scan")
        watcher.watch(page.url)
        watcher.start()
        assert came.wait(30)
        watcher.close()
    snapshot, detail, problem = reported[0]
    assert (snapshot["version"], detail["entity"], problem) == (VERSION, "topic:/scan", "")
    with pytest.raises(monitor.MonitorError, match="no answer"):
        monitor.fetch("127.0.0.1:1", "snapshot.json")
    with pytest.raises(monitor.MonitorError, match="no address"):
        monitor.fetch("file:///etc/passwd", "snapshot.json")


SHOW = """
import json, sys, types
from PyQt5 import QtCore, QtGui, QtWidgets
QtCore.Signal = QtCore.pyqtSignal
for name, module in (("QtCore", QtCore), ("QtGui", QtGui), ("QtWidgets", QtWidgets)):
    sys.modules["python_qt_binding." + name] = module
sys.modules["python_qt_binding"] = types.ModuleType("python_qt_binding")
application = QtWidgets.QApplication(["test"])
from rqt_roslens.board import Board
board = Board("robot:8080")
asked = []
board.chosen.connect(asked.append)
look = json.load(sys.stdin)
for _ in range(2):
    board.show_look(look["snapshot"], None, "")
board._go_to(board.alerts.item(0))
board.show_look(None, look["detail"], "no answer: refused")
board.resize(900, 600)
board.show()
application.processEvents()
rows = [item.text(0) + "|" + item.text(1) for item in board._items.values()]
print(json.dumps({
    "rows": rows, "alerts": board.alerts.count(), "asked": asked, "head": board.head.text(),
    "judged": [board.judged.item(0, at).text() for at in range(4)], "values": board.values.rowCount(),
    "chosen": board.tree.currentItem().text(0),
}))
"""


@pytest.mark.real
def test_the_board_shows_it_with_qt(robot):
    if subprocess.run(
        ["/usr/bin/python3", "-c", "import PyQt5.QtWidgets"], capture_output=True, check=False
    ).returncode:
        pytest.skip("no PyQt5: `apt-get install python3-pyqt5`")
    look = {"snapshot": json.loads(robot.page.newest()), "detail": json.loads(robot.page.detail("topic:/scan"))}
    done = subprocess.run(
        ["/usr/bin/python3", "-c", SHOW], input=json.dumps(look), capture_output=True, text=True, check=False,
        env={**os.environ, "PYTHONPATH": str(SOURCE), "QT_QPA_PLATFORM": "offscreen"},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    shown = json.loads(done.stdout)
    assert "/scan|\u25bc low" in shown["rows"]
    assert len(shown["rows"]) == len(look["snapshot"]["rows"])
    assert (shown["alerts"], shown["asked"], shown["chosen"]) == (1, ["topic:/scan"], "/scan")
    assert shown["judged"] == ["\u25bc low", "Rate", "4 Hz", "8..12 Hz"]
    assert shown["values"] == len(look["detail"]["values"])
    assert shown["head"].startswith("NOT CURRENT: no answer")
