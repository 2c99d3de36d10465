"""Versions of everything that shapes a result."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from importlib.metadata import version

import roslens
from roslens.plugins.member import Member

PARSERS = ("tree-sitter", "tree-sitter-cpp", "tree-sitter-python")


def tool_versions(plugins: Sequence[Member]) -> dict[str, str]:
    """Return the versions of roslens, Python, the parsers and the plug-ins, by name."""
    versions = {"roslens": roslens.__version__, "python": platform.python_version()}
    versions |= {name: version(name) for name in PARSERS}
    return versions | {member.name: member.manifest.version for member in plugins}
