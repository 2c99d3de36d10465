"""The real rqt of ROS 1 on a display that nobody sees: with the plug-in of roslens, and with rqt_robot_monitor.

Debian has Qt, its Python binding, rospy and the master, and not rqt itself. Its sources are looked for in `build/rqt`:

    git clone https://github.com/ros-visualization/rqt build/rqt/rqt
    git clone --branch melodic-devel https://github.com/ros-visualization/qt_gui_core build/rqt/qt_gui_core
    git clone --branch ros1 https://github.com/ros-visualization/rqt_robot_monitor build/rqt/rqt_robot_monitor
"""

import contextlib
import json
import os
import shutil
import socket
import subprocess
import time
from pathlib import Path

import msgspec
import pytest
from dashboard.live.scripted_robot import ScriptedRobot

from roslens.dashboard.live.serving import LivePage
from roslens.live.publish.diagnostics import diagnostics

pytestmark = pytest.mark.real

ROOT = Path(__file__).parents[2]
SOURCES = ROOT / "build" / "rqt"
PACKAGES = (
    SOURCES / "rqt/rqt_gui", SOURCES / "rqt/rqt_gui_py", SOURCES / "qt_gui_core/qt_gui",
    SOURCES / "rqt_robot_monitor", ROOT / "ros/rqt_roslens",
)  # fmt: skip
DEBIAN = "xvfb python3-python-qt-binding python3-rospy python3-rosmaster python3-diagnostic-msgs python3-catkin-pkg"
STARTED_S = 60.0
DRIVE = """
import json, sys
from python_qt_binding.QtCore import QTimer
from python_qt_binding.QtWidgets import QApplication
import qt_gui.main
plugin, given, statuses = sys.argv[1], sys.argv[2], json.loads(sys.argv[3])
state = {}

def widget(name):
    return next((one for one in QApplication.instance().allWidgets() if type(one).__name__ == name), None)

def below(item):
    for at in range(item.childCount()):
        child = item.child(at)
        yield child.text(0) + "|" + child.text(1)
        yield from below(child)

def told(found, window):
    platform = QApplication.instance().platformName()
    print(json.dumps({**found, "title": window.windowTitle(), "window": type(window).__name__, "platform": platform}))
    sys.stdout.flush()
    state["timer"].stop()
    window.close()
    QApplication.instance().quit()

def look():
    board = widget("Board")
    if board is not None and board.tree.topLevelItemCount():
        if "chosen" not in state and board.alerts.count():
            state["chosen"] = True
            board._go_to(board.alerts.item(0))
        elif board.judged.rowCount():
            rows = [item.text(0) + "|" + item.text(1) for item in board._items.values()]
            told({"rows": rows, "judged": [board.judged.item(0, at).text() for at in range(4)]}, board.window())
    monitor = widget("RobotMonitorWidget")
    if monitor is not None:
        if "publisher" not in state:
            import rospy
            from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
            state["publisher"] = rospy.Publisher("diagnostics_agg", DiagnosticArray, queue_size=1, latch=True)
            array = DiagnosticArray()
            array.status = [
                DiagnosticStatus(level, name, message, host, [KeyValue(*pair) for pair in pairs])
                for level, name, message, host, pairs in statuses
            ]
            array.header.stamp = rospy.Time.from_sec(1.0)
            state["publisher"].publish(array)
        trees = monitor.err_flattree, monitor.warn_flattree
        rows = [row for tree in trees for row in below(tree.invisibleRootItem())]
        if rows:
            told({"rows": rows}, monitor.window())

create = qt_gui.main.Main.create_application
def made(self, argv):
    application = create(self, argv)
    state["timer"] = timer = QTimer(application)
    timer.timeout.connect(look)
    timer.start(100)
    return application

qt_gui.main.Main.create_application = made
from rqt_gui.main import Main
sys.exit(Main().main(["rqt", "--standalone", plugin, *(["--args", given] if given else [])]))
"""


def missing():
    """Return what is not there of what real rqt takes; empty where all is."""
    if not shutil.which("xvfb-run") or not shutil.which("rosmaster"):
        return f"no Xvfb or rosmaster: apt-get install {DEBIAN}"
    parts = "import python_qt_binding.QtWidgets, rospy, rospkg, catkin_pkg, diagnostic_msgs"
    if subprocess.run(["/usr/bin/python3", "-c", parts], capture_output=True, check=False).returncode:
        return f"not all of Qt and rospy is there: apt-get install {DEBIAN}"
    absent = [str(one.relative_to(ROOT)) for one in PACKAGES if not (one / "package.xml").exists()]
    return (
        f"rqt is not in Debian, and no source of it in {', '.join(absent)}: see the first lines here" if absent else ""
    )


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


@pytest.fixture
def rqt(tmp_path):
    """Return what runs rqt with a plug-in until what it shows is known."""
    if why := missing():
        pytest.skip(why)
    port = free_port()
    home = tmp_path / "home"
    home.mkdir(mode=0o700)
    environment = {
        "PATH": os.environ["PATH"], "HOME": str(home), "XDG_RUNTIME_DIR": str(home), "ROS_IP": "127.0.0.1",
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_PACKAGE_PATH": ":".join(map(str, PACKAGES)),
        "PYTHONPATH": ":".join(str(one / "src") for one in PACKAGES), "PYTHONDONTWRITEBYTECODE": "1",
    }  # fmt: skip
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with subprocess.Popen(["rosmaster", "--core", "-p", str(port)], env=environment, **quiet) as master:
        end = time.monotonic() + STARTED_S
        while time.monotonic() < end:
            with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1):
                break

        def run(plugin, given="", statuses=()):
            words = ["xvfb-run", "-a", "/usr/bin/python3", "-c", DRIVE, plugin, given, json.dumps(statuses)]
            done = subprocess.run(
                words, env=environment, capture_output=True, text=True, check=False, timeout=2 * STARTED_S
            )
            lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
            assert lines, done.stderr
            return json.loads(lines[-1])

        yield run
        master.terminate()


@pytest.fixture
def robot():
    made = ScriptedRobot()
    made.rates["/scan"] = 4
    made.run(5)
    return made


@pytest.mark.timeout(300)
def test_rqt_shows_tree_and_detail_of_roslens(rqt, robot):
    with LivePage(robot.page.newest, detail=robot.page.detail) as page:
        found = rqt("rqt_roslens.plugin.RoslensPlugin", page.url)
    assert (found["window"], found["platform"]) == ("MainWindow", "xcb")
    assert "Roslens" in found["title"]
    assert "/scan|\u25bc low" in found["rows"]
    assert found["judged"] == ["\u25bc low", "Rate", "4 Hz", "8..12 Hz"]


@pytest.mark.timeout(300)
def test_rqt_robot_monitor_reads_the_diagnostics_of_roslens(rqt, robot):
    statuses = [msgspec.to_builtins(one) for one in diagnostics(robot.session.monitor.standing())]
    found = rqt("rqt_robot_monitor.robot_monitor_plugin.RobotMonitorPlugin", statuses=statuses)
    assert any("scan" in row and "rate is low: 4 Hz" in row for row in found["rows"]), found["rows"]
