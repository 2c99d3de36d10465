"""The tool ``ament_lint_cmake``: CMake style."""

from __future__ import annotations

from roslens.source.tools.ament import AmentLinter


class AmentLintCmake(AmentLinter):
    """Style of CMake."""

    name = "ament_lint_cmake"
    program = "ament_lint_cmake"
    text = "Style of CMakeLists.txt and CMake modules."
    languages = ("cmake",)
    check = "cmake"


plugin = AmentLintCmake()
