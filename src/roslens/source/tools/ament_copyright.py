"""The tool ``ament_copyright``: copyright notices and licences as ROS 2 asks for them."""

from __future__ import annotations

from roslens.source.tools.ament import AmentLinter


class AmentCopyright(AmentLinter):
    """Heads of files."""

    name = "ament_copyright"
    program = "ament_copyright"
    text = "Copyright notice and licence in the head of each file."
    languages = ("c", "cpp", "python", "launch_python")
    check = "copyright"


plugin = AmentCopyright()
