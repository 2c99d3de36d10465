"""The tool ``ament_pep257``: docstrings by pydocstyle, with the settings of ROS 2."""

from __future__ import annotations

from roslens.source.tools.ament import AmentLinter


class AmentPep257(AmentLinter):
    """Docstrings."""

    name = "ament_pep257"
    program = "ament_pep257"
    text = "Docstrings of Python, with the settings of ROS 2."
    languages = ("python", "launch_python")
    check = "pep257"
    get = f"pip install ros-ament-pep257 pydocstyle, or {AmentLinter.get}"


plugin = AmentPep257()
