import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from testbed import leftovers, robot_ros1, robot_ros2

pytestmark = pytest.mark.real
TESTS = Path(__file__).parents[1]


def read_until(process: subprocess.Popen[str], mark: str, limit: float) -> str:
    """What the process writes up to the line with `mark`; its end and the time limit end it too."""
    text, deadline = "", time.monotonic() + limit
    assert process.stdout is not None
    while mark not in text and time.monotonic() < deadline and (line := process.stdout.readline()):
        text += line
    return text


@pytest.fixture
def testbed(request, allowed):
    if robot_ros1.why_not() and robot_ros2.why_not():
        pytest.skip(f"no ROS here: {robot_ros1.why_not()}; {robot_ros2.why_not()}")
    process = subprocess.Popen(
        [sys.executable, "-m", "testbed", "--for=120", *request.param],
        env={**os.environ, "PYTHONPATH": str(TESTS)},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    yield process
    process.kill()
    process.wait()
    assert process.stdout is not None
    process.stdout.close()


@pytest.mark.nightly
@pytest.mark.parametrize("testbed", [["--reactions"]], indirect=True)
def test_it_helps_itself_and_tells_what_is_done(testbed):
    text = read_until(testbed, "all that is done is told here", 100)
    kill, hold = re.search(r"kill -9 \d+", text), re.search(r"\S+/in-base .* react --hold .*", text)
    assert kill, text
    assert hold, text
    subprocess.run(kill[0], shell=True, check=True)
    told = read_until(testbed, "verified", 60)
    assert "[actions.gone/" in told
    assert "started again as process" in told, told
    assert "everything is held" in subprocess.run(hold[0], shell=True, capture_output=True, text=True).stdout
    assert "held" in read_until(testbed, "I look at it", 30)
    testbed.send_signal(signal.SIGINT)
    assert testbed.wait(60) == 0


@pytest.mark.parametrize("testbed", [["--comes-back=1", "--no-reactions"]], indirect=True)
def test_the_commands_it_prints_work_and_ctrl_c_ends_it(testbed):
    text = read_until(testbed, "All topics are heard", 60)
    assert "All topics are heard" in text, text
    entrance = re.search(r"\S+/in-sensor", text)
    kill = re.search(r"kill -9 \d+", text)
    full = re.search(r"full disk +(.*?) +#", text)
    late = re.search(r"delay +(.*?) +#", text)
    assert all((entrance, kill, full, late)), text
    assert subprocess.run([entrance[0], "hostname"], capture_output=True, text=True).stdout == "sensor\n"
    assert "No space left" in subprocess.run(full[1], shell=True, capture_output=True, text=True).stderr
    assert '"delay_ms": 20.0' in subprocess.run(late[1], shell=True, capture_output=True, text=True).stdout
    subprocess.run(kill[0], shell=True, check=True)
    assert "lidar is back" in read_until(testbed, "lidar is back", 60)
    testbed.send_signal(signal.SIGINT)
    assert testbed.wait(60) == 0
    assert leftovers.namespaces(f"roslens-{testbed.pid}-") == []


def test_without_ros_it_says_what_is_missing(allowed, tmp_path):
    tools = tmp_path / "bin"
    tools.mkdir()
    for name in ("ip", "tc", "nft", "nsenter", "unshare", "mount", "sh"):
        found = subprocess.run(["sh", "-c", f"command -v {name}"], capture_output=True, text=True).stdout.strip()
        (tools / name).symlink_to(found)
    environment = {"PATH": str(tools), "PYTHONPATH": str(TESTS), "ROSLENS_ROS2_PYTHON": "/no/python"}
    done = subprocess.run([sys.executable, "-m", "testbed"], env=environment, capture_output=True, text=True)
    assert done.returncode == 2
    assert "'/no/python'" in done.stderr
    assert "'roscore'" in done.stderr
