"""The environment in which nodes in any language count their own traffic: a library preloaded around the rmw calls.

Of two hooks in a process only one counts a message. The one in Python alone sees the stamps in messages and what
answers what: it claims what rclpy takes and publishes in ROSLENS_RCLPY_HOOK, by the number of its process and the words
"taken" and "published", and the library leaves that to it. When the claim goes, the library counts within a second.
Services, the log and what nobody claims are the library's.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

from roslens.live.inside.slots import VARIABLE, folder_of

LIBRARY = "libroslens_rmw_hook.so"
PRELOAD = "LD_PRELOAD"

_HERE = Path(__file__).parent
_REPOSITORY = _HERE.parents[3]


def library() -> Path | None:
    """Return the library that was built with this package; None where there is none that can be preloaded."""
    found = _found()
    return found if found is not None and not _unusable(found) else None


def why_no_library() -> str:
    """Return why there is no library to preload, and the remedy; empty if there is one."""
    if not sys.platform.startswith("linux"):
        return f"Nodes in C++ cannot be counted from inside on {sys.platform}; expected Linux. Watch them with --tap"
    found = _found()
    if found is None:
        return (
            f"{LIBRARY} is not in {_HERE}: there was no C compiler when roslens was built. Nodes in C++ are not counted"
            " from inside. Install a C compiler and roslens again, or watch them with --tap"
        )
    if _unusable(found):
        return (
            f'"{found}" cannot be preloaded: {PRELOAD} takes no path with a space or a colon.'
            " Install roslens in a folder without them, or watch nodes in C++ with --tap"
        )
    return ""


def preload_environment(base: Mapping[str, str]) -> dict[str, str]:
    """Return the variables to set so that nodes started with them count what they publish and take.

    Args:
        base: the environment so far; what it preloads already stays so.

    Returns:
        The variables; none where there is no library, see ``why_no_library``.
    """
    found = library()
    if found is None:
        return {}
    return {PRELOAD: ":".join([str(found), *_others(base)]), VARIABLE: folder_of(base)}


def preload_undone(base: Mapping[str, str]) -> dict[str, str | None]:
    """Return what takes ``preload_environment`` back; None is a variable to remove, none are named without need."""
    others = _others(base)
    return {PRELOAD: ":".join(others) or None, VARIABLE: None} if others != _preloaded(base) else {}


def _preloaded(base: Mapping[str, str]) -> list[str]:
    return [path for path in base.get(PRELOAD, "").replace(" ", ":").split(":") if path]


def _others(base: Mapping[str, str]) -> list[str]:
    return [path for path in _preloaded(base) if Path(path).name != LIBRARY]


def _found() -> Path | None:
    # Beside this file in an installed package; where the build puts it in a repository that is installed editable.
    for place in (_HERE / LIBRARY, _REPOSITORY / "build" / "native" / LIBRARY):
        if place.is_file():
            return place
    return None


def _unusable(path: Path) -> bool:
    return any(separator in str(path) for separator in " :")
