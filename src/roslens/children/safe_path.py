"""Where a child process may import from: never from the folder that happens to be the current one.

``python -c`` puts the current folder first on ``sys.path``, and an empty entry of ``PYTHONPATH`` means it too. A file
``struct.py`` of a workspace that is analysed would then be imported in place of the standard library's. ``-P`` exists
from Python 3.11 on only, so children are started in a folder that only the administrator can write to, and with the
current folder taken off the path before anything else is imported.

The other variables of :data:`SEARCH_PATHS` mean the current folder by an empty entry, too: the linker would load a
library of the workspace into whatever program is started there. Lines like ``export PYTHONPATH=$PYTHONPATH:/opt/…``
leave such an entry.
"""

from __future__ import annotations

import contextlib
import os
import threading
from collections.abc import Iterator, Mapping, Sequence

NEUTRAL = os.path.abspath(os.sep)  # noqa: PTH100 - the root of this drive
"""A folder in which no workspace can lie, and no module beside it."""

_FIRST = "import sys; sys.path[:] = [one for one in sys.path if one not in ('', '.', {neutral!r})]; "
_EXACT = "import sys; sys.path[:] = {path!r}; "
_SAFE = "PYTHONSAFEPATH"

SEARCH_PATHS = ("PATH", "PYTHONPATH", "LD_LIBRARY_PATH")
"""Variables by whose folders programs, modules and libraries are found, in what is started."""

_starting = threading.Lock()
_shortened: list[str] = []


def python_words(python: str, code: str, words: Sequence[str] = (), path: Sequence[str] | None = None) -> list[str]:
    """Return the command that runs ``code`` in a Python, of which no module comes from the current folder.

    Args:
        python: the program; may be another version than this one.
        code: statements, run once the path is safe.
        words: what ``sys.argv`` has after its first.
        path: what ``sys.path`` is to be; None for that of ``python`` itself. Relative entries are left out.
    """
    first = _FIRST.format(neutral=NEUTRAL) if path is None else _EXACT.format(path=absolute(path))
    return [os.path.abspath(python) if os.sep in python else python, "-c", first + code, *words]  # noqa: PTH100 - no links followed


def absolute(path: Sequence[str]) -> list[str]:
    """Return the entries of a search path that do not depend on the current folder."""
    return [one for one in path if os.path.isabs(one)]  # noqa: PTH117 - an entry may be no path at all


def safe_environment(base: Mapping[str, str]) -> dict[str, str]:
    """Return the environment in which Python leaves the current folder off its path, from 3.11 on."""
    return {**without_current_folder(base), _SAFE: "1"}


def without_current_folder(base: Mapping[str, str]) -> dict[str, str]:
    """Return an environment whose search paths have no entry that depends on the current folder."""
    return {**base, **absolute_search_paths(base)}


def absolute_search_paths(base: Mapping[str, str]) -> dict[str, str]:
    """Return those of :data:`SEARCH_PATHS` that have an entry which depends on the current folder, without it."""
    parts = {name: base[name].split(os.pathsep) for name in SEARCH_PATHS if base.get(name)}
    # An empty PATH would mean the current folder again.
    return {
        name: os.pathsep.join(absolute(given)) or NEUTRAL for name, given in parts.items() if absolute(given) != given
    }


def shorten_search_paths() -> None:
    """Take what depends on the current folder off the search paths of this process, for all that it starts."""
    shorter = absolute_search_paths(os.environ)
    os.environ.update(shorter)
    _shortened.extend(shorter)


def shortened_search_paths() -> tuple[str, ...]:
    """Return the names of the search paths that were shortened."""
    return tuple(_shortened)


@contextlib.contextmanager
def elsewhere() -> Iterator[None]:
    """Be in a neutral folder with a safe path while the standard library starts a helper process of its own.

    The forkserver and the resource tracker of ``multiprocessing`` are started as ``python -c`` in the current folder
    and environment, and nothing says otherwise.
    """
    with _starting:
        try:
            here = os.open(".", os.O_RDONLY)
        except OSError:  # the current folder is gone, so nothing can be imported from it
            here = -1
        before = os.environ.get(_SAFE)
        os.environ[_SAFE] = "1"
        try:
            os.chdir(NEUTRAL)
            yield
        finally:
            if before is None:
                del os.environ[_SAFE]
            else:
                os.environ[_SAFE] = before
            if here >= 0:
                os.fchdir(here)
                os.close(here)
