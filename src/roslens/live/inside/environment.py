"""The environment in which nodes count their own traffic."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from roslens.live.inside.preload import preload_environment, preload_undone
from roslens.live.inside.slots import VARIABLE, folder_of

PATH = str(Path(__file__).parent / "path")
"""The folder whose sitecustomize installs the hooks."""


def environment(base: Mapping[str, str]) -> dict[str, str]:
    """Return the variables to set, beside those of ``base``, so that nodes count what they publish and take.

    Those in Python do so by an import hook, those in other languages by a preloaded library where there is one.
    """
    others = _without(base.get("PYTHONPATH", ""))
    return {
        **preload_environment(base),
        "PYTHONPATH": os.pathsep.join([PATH, *others]),
        VARIABLE: folder_of(base),
    }


def undone(base: Mapping[str, str]) -> dict[str, str | None]:
    """Return what takes ``environment`` back; None is a variable to remove."""
    others = _without(base.get("PYTHONPATH", ""))
    return {**preload_undone(base), "PYTHONPATH": os.pathsep.join(others) or None, VARIABLE: None}


def _without(path: str) -> list[str]:
    return [folder for folder in path.split(os.pathsep) if folder and folder != PATH]
