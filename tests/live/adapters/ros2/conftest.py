import os
from pathlib import Path

import pytest

WHEELS = Path(__file__).parents[4] / "build" / "ros2" / "bin" / "python"


@pytest.fixture(scope="session")
def ros2_python() -> str:
    """A Python with rclpy."""
    named = os.environ.get("ROSLENS_ROS2_PYTHON")
    if named:
        return named
    if not WHEELS.exists():
        pytest.skip("no Python with rclpy: `make parts` makes build/ros2, or name one in $ROSLENS_ROS2_PYTHON")
    return str(WHEELS)
