"""roslens_msgs for Python of both generations of ROS, and a ROS 1 master."""

import hashlib
import os
import selectors
import shutil
import socket
import subprocess
import tempfile
from pathlib import Path

import pytest

from roslens.live.adapters.child import clean_environment

ROOT = Path(__file__).parents[2]
PACKAGE = ROOT / "ros" / "roslens_msgs"
BUILDER = Path(__file__).with_name("build_messages.py")
WHEELS = ROOT / "build" / "ros2" / "bin" / "python"
GENPY = Path("/usr/lib/genpy/genmsg_py.py")
PYTHON1 = "/usr/bin/python3"


@pytest.fixture(scope="session")
def ros2_python():
    """A Python with rclpy."""
    if named := os.environ.get("ROSLENS_ROS2_PYTHON"):
        return named
    if not WHEELS.exists():
        pytest.skip("no Python with rclpy: `make parts` makes build/ros2, or name one in $ROSLENS_ROS2_PYTHON")
    return str(WHEELS)


@pytest.fixture(scope="session")
def messages2(ros2_python):
    """A folder in which rclpy's Python finds roslens_msgs, built from the package by the generators of the wheels."""
    for compiler in ("gcc", "g++"):
        if not shutil.which(compiler):
            pytest.skip(f"no {compiler}, which the messages of ROS 2 need")
    probe = subprocess.run(
        [ros2_python, "-c", "import rosidl_adapter, numpy, rosidl_generator_py, rosidl_typesupport_fastrtps_c"],
        env=clean_environment(os.environ), capture_output=True, text=True, check=False,
    )  # fmt: skip
    if probe.returncode:
        pytest.skip(f"{ros2_python} has no generators of messages: {probe.stderr.strip().splitlines()[-1]}")
    parts = [file.read_bytes() for file in (BUILDER, *sorted(PACKAGE.glob("msg/*.msg")))]
    kept = ROOT / "build" / "roslens_msgs" / hashlib.sha256(b"\0".join([ros2_python.encode(), *parts])).hexdigest()[:16]
    if not kept.exists():
        kept.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=kept.parent) as folder:
            made = Path(folder) / "made"
            made.mkdir()
            built = subprocess.run(
                [ros2_python, str(BUILDER), str(PACKAGE), str(made)], env=clean_environment(os.environ),
                capture_output=True, text=True, check=False,
            )  # fmt: skip
            assert not built.returncode, built.stdout + built.stderr
            if not kept.exists():  # another worker may have been quicker
                made.rename(kept)
    return kept / "python"


@pytest.fixture(scope="session")
def messages1(tmp_path_factory):
    """A folder in which Debian's Python of ROS 1 finds roslens_msgs, made by genpy."""
    if not GENPY.exists():
        pytest.skip("genpy is not installed")
    folder = tmp_path_factory.mktemp("ros1")
    out = folder / "roslens_msgs" / "msg"
    out.mkdir(parents=True)
    places = [f"-Iroslens_msgs:{PACKAGE / 'msg'}", "-Istd_msgs:/usr/share/std_msgs/msg"]
    environment = {**os.environ, "PYTHONPATH": ""}
    for file in sorted(PACKAGE.glob("msg/*.msg")):
        words = [PYTHON1, str(GENPY), "-p", "roslens_msgs", *places, "-o", str(out), str(file)]
        subprocess.run(words, check=True, env=environment)
    subprocess.run([PYTHON1, str(GENPY), "--initpy", "-o", str(out)], check=True, env=environment)
    (folder / "roslens_msgs" / "__init__.py").touch()
    return folder


@pytest.fixture
def master(tmp_path):
    """The environment in which a ROS 1 master of its own is found."""
    if not shutil.which("roscore"):
        pytest.skip("roscore is not installed")
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    environment = {
        **clean_environment(os.environ), "ROS_MASTER_URI": f"http://127.0.0.1:{port}", "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(tmp_path / "home"), "ROS_LOG_DIR": str(tmp_path / "log"),
    }  # fmt: skip
    environment.pop("PYTHONPATH", None)
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    core = subprocess.Popen(["roscore", "-p", str(port)], env=environment, start_new_session=True, **quiet)
    try:
        for _ in range(600):
            ready = subprocess.run(["rosnode", "ping", "-c1", "/rosout"], env=environment, check=False, **quiet)
            if not ready.returncode:
                break
            selectors.DefaultSelector().select(0.05)
        else:
            pytest.fail("roscore does not answer")
        yield environment
    finally:
        core.terminate()
        core.wait(20)
