"""Which foreign tools there are, by name."""

from __future__ import annotations

TOOLS = (
    "ruff",
    "clang_format",
    "catkin_lint",
    "ament_copyright",
    "ament_flake8",
    "ament_pep257",
    "ament_lint_cmake",
    "ament_xmllint",
    "cpplint",
    "cppcheck",
    "pylint",
    "clang_tidy",
)
"""Modules of this folder with an object ``plugin``, in the order in which they run."""


NOT_RUN = "not run: "
"""How the version of a tool begins that ``all`` stands for and that cannot run."""


def plain(name: str) -> str:
    """Return the name of a tool as it is spelled here: ``clang-tidy`` is ``clang_tidy``."""
    return name.strip().replace("-", "_").lower()
