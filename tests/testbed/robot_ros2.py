"""The three-host robot on ROS 2: nodes with rclpy, found by multicast."""

import os
import subprocess
from functools import cache
from pathlib import Path
from typing import Any

from testbed.hosts import Bed, Host
from testbed.robot import Robot

DOMAIN = 17
BUILT = Path(__file__).parents[2] / "build" / "ros2" / "bin" / "python"


def python() -> str:
    """The interpreter with rclpy: $ROSLENS_ROS2_PYTHON, else the one that `make parts` has built."""
    return os.environ.get("ROSLENS_ROS2_PYTHON") or str(BUILT)


@cache
def why_not() -> str | None:
    """The reason why ROS 2 nodes cannot run on this machine, or None where they can."""
    if not Path(python()).exists():
        return f"no {python()!r} found; run `make parts`, or name a Python with rclpy in ROSLENS_ROS2_PYTHON"
    plain = {"PATH": os.environ.get("PATH", "/usr/bin:/bin")}
    modules = "import rclpy, geometry_msgs.msg, sensor_msgs.msg, std_msgs.msg"
    tried = subprocess.run([python(), "-c", modules], env=plain, capture_output=True, text=True, check=False)
    if tried.returncode != 0:
        return f"{python()!r} cannot import ROS 2: {(tried.stderr.strip() or 'no reason given').splitlines()[-1]}"
    return None


class Ros2Robot(Robot):
    """See `Robot`. `domain` is the robot's own."""

    generation = "ros2"

    def __init__(self, bed: Bed, *, domain: int = DOMAIN, **options: Any) -> None:
        super().__init__(bed, **options)
        self.domain = domain

    def python(self) -> str:
        """See the function of the same name."""
        return python()

    def environment(self, host: Host) -> dict[str, str]:
        """Discovery over the bed's network, which nobody outside shares.

        The wheels restart their interpreter with a library path of their own and leave two variables behind; a host's
        environment begins without either.
        """
        return {
            "ROS_DOMAIN_ID": str(self.domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET",
            "ROS_HOME": str(host.folder / "ros"),
        }
