"""Puts packages of a workspace where ROS 2 looks for them, as their builds would: an ament prefix in a folder.

Of a package in Python, ``setup.py`` is run with a ``setup`` that only notes what it is told; nothing here is read by
roslens, so that what it reads is compared with something else. Programs in C++ are not built.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

_NOTE = """
import json, os, sys, setuptools
def setup(**told):
    files = [[folder, [str(one) for one in names]] for folder, names in told.get("data_files", [])]
    scripts = told.get("entry_points", {}).get("console_scripts", [])
    sys.stderr.write("\\nTOLD " + json.dumps([files, list(scripts)]))
setuptools.setup = setup
sys.argv = ["setup.py", "install"]
seen_as = {"__file__": os.path.abspath("setup.py"), "__name__": "__main__"}
exec(compile(open("setup.py").read(), "setup.py", "exec"), seen_as)
"""
_PROGRAM = """#!{python}
import sys
from {module} import {function}
sys.exit({function}())
"""


def install(workspace: Path, prefix: Path, python: str) -> list[Path]:
    """Install all packages below a folder and return the folders that Python has to look in.

    Args:
        workspace: with packages.
        prefix: to install into.
        python: that programs are run by.
    """
    paths = []
    for manifest in sorted(workspace.rglob("package.xml")):
        package = manifest.parent
        found = re.search(r"<name>\s*(\S+?)\s*</name>", manifest.read_text())
        assert found is not None, manifest
        name = found[1]
        marker = prefix / "share" / "ament_index" / "resource_index" / "packages" / name
        marker.parent.mkdir(parents=True, exist_ok=True)
        marker.touch()
        if (package / "setup.py").exists():
            _install_python(package, name, prefix, python)
            paths.append(package)
        else:
            shutil.copytree(package, prefix / "share" / name, dirs_exist_ok=True)
            _install_scripts(package, prefix / "lib" / name, python)
    return paths


def _install_scripts(package: Path, programs: Path, python: str) -> None:
    """Install what a package of CMake has in ``scripts``."""
    for script in sorted((package / "scripts").glob("*.py")):
        programs.mkdir(parents=True, exist_ok=True)
        target = programs / script.name
        target.write_text(f"#!{python}\n{script.read_text()}")
        target.chmod(0o755)


def _install_python(package: Path, name: str, prefix: Path, python: str) -> None:
    told = subprocess.run(
        [sys.executable, "-c", _NOTE], cwd=package, env={**os.environ, "PYTHONWARNINGS": "ignore"},
        capture_output=True, text=True, check=True,
    ).stderr  # fmt: skip
    files, scripts = json.loads(told.rpartition("TOLD ")[2])
    for folder, names in files:
        target = prefix / folder
        target.mkdir(parents=True, exist_ok=True)
        for one in names:
            shutil.copy(package / one, target)
    programs = prefix / "lib" / name
    programs.mkdir(parents=True, exist_ok=True)
    for script in scripts:
        program, _, where = (part.strip() for part in script.partition("="))
        module, _, function = where.partition(":")
        path = programs / program
        path.write_text(_PROGRAM.format(python=python, module=module, function=function))
        path.chmod(0o755)
