"""Messages that are built for real nodes of ROS 2, and an environment that nobody else shares."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest
from ros2_domain import own_domain

from roslens.live.adapters.child import clean_environment

ROOT = Path(__file__).parents[3]
WHEELS = ROOT / "build" / "ros2" / "bin" / "python"
BUILDER = ROOT / "tests" / "ros" / "build_messages.py"


@pytest.fixture
def python() -> str:
    """A Python with rclpy, and what building messages takes."""
    found = os.environ.get("ROSLENS_ROS2_PYTHON") or str(WHEELS)
    if not Path(found).exists():
        pytest.skip("no Python with rclpy: `make parts` makes build/ros2, or name one in $ROSLENS_ROS2_PYTHON")
    for compiler in ("gcc", "g++"):
        if not shutil.which(compiler):
            pytest.skip(f"no {compiler}, which the messages of ROS 2 need")
    probe = subprocess.run(
        [found, "-c", "import rosidl_adapter, numpy, rosidl_generator_py, rosidl_typesupport_fastrtps_c"],
        env=clean_environment(os.environ), capture_output=True, text=True, check=False,
    )  # fmt: skip
    if probe.returncode:
        pytest.skip(f"{found} has no generators of messages: {probe.stderr.strip().splitlines()[-1]}")
    return found


@pytest.fixture
def built(python: str, tmp_path: Path) -> Callable[..., Path]:
    """Return what builds a package of messages, given by name, and tells the folder in which Python finds it."""

    def build(package: str, definitions: Mapping[str, str], variant: str = "", held: Sequence[str] = ()) -> Path:
        folder = tmp_path / (variant or package)
        messages = folder / package / "msg"
        messages.mkdir(parents=True)
        for name, text in definitions.items():
            (messages / f"{name}.msg").write_text(text)
        made = folder / "made"
        made.mkdir()
        done = subprocess.run(
            [python, str(BUILDER), str(messages.parent), str(made), *held], env=clean_environment(os.environ),
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert not done.returncode, done.stdout + done.stderr
        return made / "python"

    return build


@pytest.fixture
def alone(python: str, tmp_path: Path) -> dict[str, str]:
    """Return an environment of ROS 2 for this test alone."""
    return clean_environment(os.environ) | {
        "ROS_DOMAIN_ID": own_domain(),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_LOG_DIR": str(tmp_path / "log"),
        "ROSLENS_COUNTERS": str(tmp_path / "counters"),
        "ROSLENS_ROS2_PYTHON": python,
    }
