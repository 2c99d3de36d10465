"""The tool ``ament_flake8``: Python style by flake8, with the settings of ROS 2."""

from __future__ import annotations

from roslens.source.tools.ament import AmentLinter


class AmentFlake8(AmentLinter):
    """Style and mistakes of Python."""

    name = "ament_flake8"
    program = "ament_flake8"
    text = "Style and mistakes of Python, with the settings of ROS 2."
    languages = ("python", "launch_python")
    check = "flake8"
    get = f"pip install ros-ament-flake8 flake8, or {AmentLinter.get}"


plugin = AmentFlake8()
