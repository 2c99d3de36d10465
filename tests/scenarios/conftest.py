"""Workspaces to be checked, and a command line to check them with."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pytest

MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>A package.</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  {more}
  <export><build_type>ament_cmake</build_type></export>
</package>
"""

BUILD = """cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
ament_package()
"""

CLEAN = """// A small file
// with enough
// comments.
int one() { return 1; }
"""


class Done(NamedTuple):
    """How a command ended."""

    code: int
    out: str
    err: str

    def json(self) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(self.out)
        return found


Roslens = Callable[..., Done]


@pytest.fixture
def roslens(tmp_path: Path) -> Roslens:
    """Run the command line in a process of its own."""

    def run(*arguments: str | Path, environment: dict[str, str] | None = None, timeout: float = 120) -> Done:
        command = [sys.executable, "-m", "roslens.cli.main", *map(str, arguments)]
        plain = {key: value for key, value in os.environ.items() if not key.startswith("ROS_")}
        done = subprocess.run(
            command,
            capture_output=True,
            timeout=timeout,
            cwd=tmp_path,
            env={**plain, **(environment or {})},
            check=False,
        )
        out, err = done.stdout.decode("utf-8"), done.stderr.decode("utf-8")
        assert "Traceback" not in err, err
        return Done(done.returncode, out, err)

    return run


class Robot:
    """A workspace under construction."""

    def __init__(self, root: Path) -> None:
        self.root = root
        root.mkdir()

    def package(self, name: str, more: str = "", folder: str = "", **files: str) -> Path:
        """Add a package; keyword ``a__cpp`` becomes the file ``src/a.cpp``."""
        place = self.root / (folder or name)
        (place / "src").mkdir(parents=True)
        (place / "package.xml").write_text(MANIFEST.format(name=name, more=more), "utf-8")
        (place / "CMakeLists.txt").write_text(BUILD.format(name=name), "utf-8")
        for key, text in (files or {"one__cpp": CLEAN}).items():
            (place / "src" / key.replace("__", ".")).write_text(text, "utf-8")
        return place


@pytest.fixture
def robot(tmp_path: Path) -> Robot:
    return Robot(tmp_path / "robot")
