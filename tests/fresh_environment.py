"""A virtual environment for a test, filled by the pip of this one: to unpack a pip into each takes seconds."""

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path


def fresh_environment(folder: Path) -> Path:
    """Make a virtual environment without anything in it; return its Python."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
    return folder / "bin" / "python"


def pip_install(python: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Install in the environment of a Python, which sees nothing else of ours than pip."""
    pip = find_spec("pip")
    assert pip is not None, "no pip is installed with this Python"
    assert pip.origin is not None
    alone = python.parent.parent / "pip"
    alone.mkdir(exist_ok=True)
    if not (alone / "pip").exists():
        (alone / "pip").symlink_to(Path(pip.origin).parent)
    return subprocess.run(
        [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *words],
        env={**os.environ, "PYTHONPATH": str(alone)}, capture_output=True, text=True, check=False,
    )  # fmt: skip
