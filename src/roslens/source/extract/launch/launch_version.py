"""For which version of ROS a launch file is: by what it is written in, else by its package."""

from __future__ import annotations

import re
from collections.abc import Sequence

_ROS2 = re.compile(rb"<(?:node|test)\b[^>]*\s(?:exec|namespace)\s*=|\$\((?:var|find-pkg-share)\s|<let\b")
_ROS1 = re.compile(rb"<(?:node|test)\b[^>]*\stype\s*=|\$\((?:find|arg)\s|<(?:param|rosparam|machine)\b")


def launch_version(path: str, content: bytes, versions: Sequence[str] = ()) -> str:
    """Return ``ros1`` or ``ros2``.

    Args:
        path: of the file.
        content: of the file.
        versions: for which its package is built.
    """
    if path.endswith((".py", ".yaml", ".yml")) or _ROS2.search(content):
        return "ros2"
    if path.endswith(".launch.xml"):
        return "ros1" if re.search(rb"<(?:node|test)\b[^>]*\stype\s*=", content) else "ros2"
    return "ros2" if tuple(versions) == ("ros2",) and not _ROS1.search(content) else "ros1"
