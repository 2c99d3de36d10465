"""The recipe of the README: a lidar dies, the robot is stopped, the lidar runs again, and the journal says so."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from ros2_domain import own_domain

from roslens.live.adapters.child import clean_environment
from roslens.store.journals.read_journal import JournalReader, verify

pytestmark = [pytest.mark.real, pytest.mark.timed]

ROOT = Path(__file__).parents[3]
ROBOT = ROOT / "examples" / "robot"
ROSLENS = str(Path(sys.executable).parent / "roslens")
WHEELS = ROOT / "build" / "ros2" / "bin" / "python"
LIMIT_S = 90.0
HEARD = {
    "ros2": """
import rclpy
from std_msgs.msg import Bool
rclpy.init()
node = rclpy.create_node('wheels')
node.create_subscription(Bool, '/emergency_stop', lambda one: print('stop', one.data, flush=True), 10)
rclpy.spin(node)
""",
    "ros1": """
import rospy
from std_msgs.msg import Bool
rospy.init_node('wheels')
rospy.Subscriber('/emergency_stop', Bool, lambda one: print('stop', one.data, flush=True))
rospy.spin()
""",
}


class Bench:
    """Processes that end with the test, and the journal."""

    def __init__(self, folder: Path, generation: str) -> None:
        self.folder = folder
        self.generation = generation
        self.started: list[subprocess.Popen[str]] = []
        state = {"XDG_STATE_HOME": str(folder), "PYTHONDONTWRITEBYTECODE": ""}
        if generation == "ros2":
            self.python = os.environ.get("ROSLENS_ROS2_PYTHON") or str(WHEELS)
            more = {"ROS_DOMAIN_ID": own_domain(), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
            more["ROSLENS_ROS2_PYTHON"] = self.python
        else:
            self.python = "/usr/bin/python3"
            with socket.create_server(("127.0.0.1", 0)) as server:
                port = server.getsockname()[1]
            more = {"ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_IP": "127.0.0.1", "ROS_LOG_DIR": str(folder)}
        self.environment = clean_environment({**os.environ, **state, **more})
        self.environment.pop("PYTHONPATH", None)
        if generation == "ros1":
            self.start("rosmaster", "--core", "-p", str(port))

    def start(self, *words: str) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            words, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, cwd=ROOT
        )
        self.started.append(process)
        return process

    def entries(self):
        journal = self.folder / "roslens" / "journal.jsonl"
        if not journal.exists():
            return []
        reader = JournalReader(journal)
        try:
            return list(reader.entries())
        finally:
            reader.close()

    def wait(self, true):
        end = time.monotonic() + LIMIT_S
        while not (found := true()):
            assert time.monotonic() < end, self.entries()[-5:]
            time.sleep(0.1)
        return found

    def close(self):
        for entry in self.entries():
            text = str(entry.fields.get("text", ""))
            if "started again as process" in text:
                with contextlib.suppress(ProcessLookupError, ValueError):
                    os.kill(int(text.rpartition(" ")[2]), signal.SIGKILL)
        for process in reversed(self.started):
            process.kill()
            process.wait()
            process.stdout.close()


@pytest.fixture
def bench(request, tmp_path):
    generation = request.param
    if generation == "ros1" and not shutil.which("rosmaster"):
        pytest.skip("rosmaster is not installed")
    if generation == "ros2" and not (os.environ.get("ROSLENS_ROS2_PYTHON") or WHEELS.exists()):
        pytest.skip("no Python with rclpy: `make parts` makes build/ros2")
    found = Bench(tmp_path, generation)
    yield found
    found.close()


@pytest.mark.parametrize("bench", ["ros2", pytest.param("ros1", marks=pytest.mark.nightly)], indirect=True)
def test_a_lidar_that_dies_stops_the_robot_and_runs_again(bench, tmp_path):
    allow = tmp_path / "allow.yaml"
    shutil.copy(ROBOT / "allow.yaml", allow)
    allow.chmod(0o600)
    wheels = bench.start(bench.python, "-c", HEARD[bench.generation])
    lidar = bench.start(bench.python, str(ROBOT / f"{bench.generation}_lidar.py"))
    words = [str(ROBOT / "react.yaml"), "--mode", "act", "--allow", str(allow), f"--{bench.generation}"]
    react = bench.start(ROSLENS, "react", *words)
    bench.wait(lambda: any(one.what == "well" for one in bench.entries()))
    assert not [one for one in bench.entries() if one.what == "decided"], "nothing is done to what is well"
    killed = time.time()
    lidar.kill()
    lidar.wait()
    assert wheels.stdout.readline() == "stop True\n"
    bench.wait(
        lambda: any(
            one.what == "verified" and one.fields["verification"] == "gone" and ".lidar/" in one.fields["decision"]
            for one in bench.entries()
        )
    )
    react.send_signal(signal.SIGINT)
    react.wait(LIMIT_S)
    entries = bench.entries()
    kinds = [one.fields["action"]["kind"] for one in entries if one.what == "announced"]
    assert sorted(kinds[:3]) == ["notify", "publish", "restart"]
    assert "snapshot" not in kinds, "what helped is not followed by the next step"
    restarted = next(one for one in entries if one.what == "outcome" and "started again" in one.fields["text"])
    assert restarted.fields["result"] == "done"
    assert restarted.time - killed < LIMIT_S
    assert entries[-1].what == "ended"
    assert not verify(bench.folder / "roslens" / "journal.jsonl").wrong
