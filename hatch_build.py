"""Builds the preloaded library when the package is built, where there is a C compiler; without one it is left out."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

LIBRARY = "libroslens_rmw_hook.so"
FLAGS = ("-std=c11", "-D_GNU_SOURCE", "-O2", "-fPIC", "-fvisibility=hidden", "-ffp-contract=off", "-pthread")
"""Contracting multiplication and addition would make sums differ from those that the hook in Python counts."""


def compiler() -> list[str]:
    """Return the command of the C compiler; empty where there is none."""
    named = shlex.split(os.environ.get("CC", ""))
    if named:
        return named if shutil.which(named[0]) else []
    found = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    return [found] if found else []


def build_library(root: Path, target: Path) -> str:
    """Build the library.

    Args:
        root: of the repository.
        target: the file to write.

    Returns:
        What kept it from being built; empty if nothing did.
    """
    if not sys.platform.startswith("linux"):
        return f"the preloaded library needs Linux, this is {sys.platform}"
    command = compiler()
    if not command:
        return "no C compiler found"
    sources = sorted(str(path) for path in (root / "native").glob("*.c"))
    target.parent.mkdir(parents=True, exist_ok=True)
    # A library that nodes have mapped must not change under them: the new one takes its name when it is whole.
    fresh = target.with_suffix(".new")
    try:
        done = subprocess.run(
            [*command, *FLAGS, "-shared", "-o", str(fresh), *sources, "-ldl"],
            capture_output=True,
            text=True,
            check=False,
        )
    except OSError as error:
        return f"{command[0]} cannot be run: {error}"
    if done.returncode:
        fresh.unlink(missing_ok=True)
        return f"{command[0]} failed:\n{done.stderr}"
    fresh.replace(target)
    return ""


class NativeBuildHook(BuildHookInterface):  # type: ignore[type-arg]  # the argument is hatchling's own
    """Puts the library into wheels, and beside the sources of an editable install."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build before the files are collected."""
        root = Path(self.root)
        target = root / "build" / "native" / LIBRARY
        target.unlink(missing_ok=True)
        problem = build_library(root, target)
        if problem:
            self.app.display_warning(f"the library to preload into nodes is left out: {problem}")
        elif version == "standard":
            build_data["force_include"][str(target)] = f"roslens/live/inside/{LIBRARY}"
            build_data["pure_python"] = False
            platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
            build_data["tag"] = f"py3-none-{platform}"
