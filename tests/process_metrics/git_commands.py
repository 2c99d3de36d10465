"""A command of the shell in a clone, and what it writes; nothing of roslens takes part."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Sequence
from pathlib import Path


def asked(folder: Path, command: str, *words: str) -> str:
    """Return what a command of the shell writes in a folder; ``words`` are its parameters, as ``"$@"``.

    Raises:
        RuntimeError: it fails, or says that something is wrong.
    """
    environment = {**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1", "LC_ALL": "C"}
    environment |= {"GIT_CONFIG_COUNT": "1", "GIT_CONFIG_KEY_0": "safe.directory", "GIT_CONFIG_VALUE_0": "*"}
    done = subprocess.run(
        ["bash", "-c", command, "bash", *words],
        cwd=folder, capture_output=True, text=True, errors="replace", check=False, env=environment, timeout=600,
    )  # fmt: skip
    if "fatal:" in done.stderr or "error:" in done.stderr:
        raise RuntimeError(f"{command[:200]}: {done.stderr.strip()[:400]}")
    return done.stdout.strip("\n ")


def lines_of(folder: Path, command: str, words: Sequence[str] = ()) -> list[str]:
    """Return the lines that a command of the shell writes in a folder."""
    return asked(folder, command, *words).splitlines()
