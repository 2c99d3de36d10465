"""No module of a workspace is imported, whatever a Python program puts on its search path.

Linters of Python put the folders of what they look at on ``sys.path`` and import lazily: a file ``multiprocessing.py``
beside the code would be imported in place of the standard library's, and an extension module by its name. Here the
search for modules leaves out all folders of the workspace that were not on the path when the program began.

This file imports nothing of roslens: it is the ``sitecustomize`` of programs that run on other Pythons, from 3.7 on,
with the folder of the workspace in ``ROSLENS_GUARDED``, and folders in it that are trusted in ``ROSLENS_IMPORTED``.
"""

from __future__ import annotations

import os
import sys
from importlib.machinery import PathFinder

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from importlib.machinery import ModuleSpec
    from typing import Any

VARIABLE, IMPORTED = "ROSLENS_GUARDED", "ROSLENS_IMPORTED"

NOT_THERE = "multiprocessing.synchronize"
"""There are no semaphores in a sandbox, as ``/dev/shm`` is everybody's.

Python lacks this module on systems without semaphores, and programs do their work in one process then; one that finds
it, and is refused a semaphore, crashes.
"""


class GuardedFinder:
    """Finds modules as Python does, but in no folder of a workspace that was not searched from the beginning."""

    def __init__(self, root: str, searched: Iterable[str], not_there: str = "") -> None:
        """Leave out folders below ``root``, but for those in ``searched``, which are real paths, and below them.

        The module named ``not_there`` is nowhere.
        """
        self._not_there = not_there
        self._root = root.rstrip(os.sep) + os.sep
        self._searched = tuple(place.rstrip(os.sep) + os.sep for place in searched)
        self._known: dict[object, bool] = {}

    def find_spec(self, fullname: str, path: Sequence[str] | None = None, target: Any = None) -> ModuleSpec | None:
        """Return where a module is; None if it is nowhere else than in the workspace."""
        if fullname == self._not_there:
            return None
        allowed = [place for place in (sys.path if path is None else path) if self._is_allowed(place)]
        return PathFinder.find_spec(fullname, allowed, target)

    def invalidate_caches(self) -> None:
        """Look anew at folders, as Python asks for."""
        self._known.clear()
        PathFinder.invalidate_caches()

    def find_distributions(self, *words: Any, **named: Any) -> Any:
        """Return installed distributions, as Python does.

        The package importlib_metadata takes this from Python's finder where it is imported, and finds them itself.
        """
        of_python = getattr(PathFinder, "find_distributions", None)
        return of_python(*words, **named) if of_python is not None else iter(())

    def _is_allowed(self, place: object) -> bool:
        if not isinstance(place, str):
            return False
        known = self._known.get(place)
        # What an empty or a relative entry means depends on the current folder.
        if known is None or not os.path.isabs(place):  # noqa: PTH117
            real = os.path.realpath(place or ".") + os.sep
            known = not real.startswith(self._root) or real.startswith(self._searched)
            self._known[place] = known
        return known


def guard_imports(root: str, not_there: str = "") -> None:
    """Leave the folders of a workspace out of the search for modules from now on.

    Args:
        root: the folder of the workspace.
        not_there: a module that is found nowhere.
    """
    real = os.path.realpath(root)
    here = os.path.realpath(".")
    places = {os.path.realpath(place) for place in sys.path if place and os.path.isabs(place)}  # noqa: PTH117
    places -= {real, here, os.sep}
    places.update(os.path.realpath(place) for place in os.environ.get(IMPORTED, "").split(os.pathsep) if place)
    finder: Any = GuardedFinder(real, sorted(places), not_there)
    sys.meta_path[:] = [finder if one is PathFinder else one for one in sys.meta_path]


if __name__ == "sitecustomize" and os.environ.get(VARIABLE):
    guard_imports(os.environ[VARIABLE], NOT_THERE)
