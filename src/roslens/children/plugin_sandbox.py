"""What plug-ins may touch: the workspace to read, themselves and installed programs to run, their own scratch to write.

Their process confines itself, and so all that they start. That takes Landlock: where the kernel has none, plug-ins run
without a sandbox, which ``roslens doctor`` reports.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Mapping
from urllib.parse import unquote, urlsplit

from roslens.children.sandbox import LANDLOCK, Sandbox, is_narrow, sandbox_kind

SWITCH = "ROSLENS_PLUGIN_SANDBOX"
"""Variable of the user: with ``off``, plug-ins run without a sandbox."""


def plugin_sandbox(
    read: Iterable[str], plugins: Iterable[str], write: Iterable[str], environment: Mapping[str, str]
) -> Sandbox | None:
    """Return what plug-ins may touch; None where there is no sandbox for them.

    Args:
        read: folders of the workspace.
        plugins: files and folders of plug-ins that were named by their path.
        write: folders that are theirs.
        environment: of the user.
    """
    if sandbox_kind() != LANDLOCK or environment.get(SWITCH, "").lower() == "off":
        return None
    looked_at = tuple(dict.fromkeys(os.path.realpath(path) for path in read))
    # A folder of modules that holds the workspace is read, and nothing in it started.
    above = [path for path in sys.path if _holds(path, looked_at)]
    apart = (path for path in _edited_folders() if not _meets(path, looked_at))
    started = (*_program_folders(environment, looked_at), *apart)
    return Sandbox(
        read=(*looked_at, *above),
        run=tuple(dict.fromkeys((*_own_folders(plugins), *started))),
        write=tuple(os.path.realpath(path) for path in write),
    )


def _own_folders(plugins: Iterable[str]) -> Iterator[str]:
    """Yield the folder of each plug-in; that of a file may hold what it reads or imports."""
    for path in plugins:
        real = os.path.realpath(path)
        folder = os.path.dirname(real)  # noqa: PTH120
        yield folder if os.path.isfile(real) and is_narrow(folder) else real  # noqa: PTH113


def _program_folders(environment: Mapping[str, str], looked_at: Iterable[str]) -> Iterator[str]:
    """Yield where programs of the user are, with the libraries beside them unless the workspace lies there, too."""
    for path in environment.get("PATH", "").split(os.pathsep):
        above = os.path.dirname(path.rstrip(os.sep))  # noqa: PTH120
        whole = os.path.basename(path.rstrip(os.sep)) in ("bin", "sbin") and is_narrow(above)  # noqa: PTH119
        for folder in (above, path) if whole else (path,):
            if is_narrow(folder) and not _meets(folder, looked_at):
                yield folder
                break


def _edited_folders() -> Iterator[str]:
    """Yield the projects that are installed as links to where they are edited: their files are on no search path."""
    import json
    from importlib.metadata import distributions

    for one in distributions():
        try:
            found = json.loads(one.read_text("direct_url.json") or "{}")
            editable, url = found.get("dir_info", {}).get("editable"), urlsplit(found.get("url", ""))
        except (OSError, ValueError, AttributeError):
            continue
        path = unquote(url.path)
        if editable and url.scheme == "file" and is_narrow(path):
            yield path


def _holds(path: str, places: Iterable[str]) -> bool:
    return is_narrow(path) and any((place + os.sep).startswith(_closed(path)) for place in places)


def _meets(path: str, places: Iterable[str]) -> bool:
    """Return whether one is in the other."""
    return _holds(path, places) or any(_closed(path).startswith(_closed(place)) for place in places)


def _closed(path: str) -> str:
    return os.path.realpath(path).rstrip(os.sep) + os.sep
