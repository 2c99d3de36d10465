"""Settings files of foreign tools in a workspace and above it: tools read them once the user trusts them.

What a linter reads from a ``.clang-tidy`` or a ``pyproject.toml`` comes with the source, like ``roslens.toml``. A tool
that the user names runs without them until they are trusted, for the folder and their content.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from hashlib import sha256
from pathlib import Path

import msgspec

from roslens.cli.workplace.configuration import Configuration
from roslens.cli.workplace.trust import content_of, place_of, read_trusted, write_trusted
from roslens.intake.is_there import is_file

_LEFT_OUT = frozenset({".git", ".hg", ".svn", ".roslens", "node_modules", "__pycache__"})
_MOST_FILES = 10_000
"""More settings files than that are no settings: the user is not asked about them, and none counts."""


def settings_files(folder: str) -> tuple[str, ...]:
    """Return the settings files of all tools in a folder, those below it and those above it.

    Links to folders are followed as in the search for packages: each folder once, and none that is around ``folder``.
    """
    names = _names()
    found: list[str] = []
    visited: set[str] = set()
    pending = [folder]
    while pending:
        for place, folders, files in os.walk(pending.pop()):
            if place in visited:
                folders.clear()
                continue
            visited.add(place)
            folders[:] = sorted(name for name in folders if name not in _LEFT_OUT)
            found += (os.path.join(place, name) for name in names.intersection(files))  # noqa: PTH118 - no Path a file
            pending += _linked(place, folders, folder)
    for above in Path(folder).parents:
        found += (str(above / name) for name in sorted(names) if is_file(above / name))
    return tuple(sorted(found))


def _linked(place: str, names: Iterable[str], start: str) -> Iterator[str]:
    """Yield the folders that links in a folder lead to, but for those around the one where the search starts."""
    for name in names:
        path = os.path.join(place, name)  # noqa: PTH118 - no Path a folder
        if os.path.islink(path):  # noqa: PTH114
            real = os.path.realpath(path)
            if not (start + os.sep).startswith(real.rstrip(os.sep) + os.sep):
                yield real


def hash_of_settings(files: tuple[str, ...]) -> str:
    """Return the hash of settings files, with their names."""
    digest = sha256()
    for file in files:
        digest.update(os.fsencode(file) + b"\0" + content_of(Path(file)))
    return digest.hexdigest()


def trust_settings(configuration: Configuration, environment: Mapping[str, str], root: Path) -> tuple[str, ...]:
    """Trust the settings files of tools of a workspace as they are now, and return them."""
    folder = place_of(configuration, root)
    files = settings_files(folder)
    trusted = read_trusted(environment)
    settings = {key: value for key, value in trusted.settings.items() if key != folder}
    if files:
        settings[folder] = hash_of_settings(files)
    write_trusted(msgspec.structs.replace(trusted, settings=settings), environment)
    return files


def with_settings_files(
    configuration: Configuration,
    *,
    given: bool,
    environment: Mapping[str, str],
    root: Path,
    ask: Callable[[str], bool] | None = None,
    tell: Callable[[str], None],
) -> Configuration:
    """Return the configuration, in which it is said whether tools read their settings files.

    Args:
        configuration: with what the user lets run.
        given: whether the command line declares the workspace trusted.
        environment: of this process, for where the user's own files are.
        root: the folder that is looked at.
        ask: asks the user; None if there is no one to ask.
        tell: hears which files do not count.

    Raises:
        UsageError: what the user trusts cannot be read.
    """
    if not given:
        folder = place_of(configuration, root)
        files = settings_files(folder)
        if len(files) > _MOST_FILES:
            tell(f"{len(files):,} settings files of tools below {folder} are not used: at most {_MOST_FILES:,} are")
            return configuration
        known = read_trusted(environment).settings.get(folder)
        if files and known != hash_of_settings(files):
            question = f"Tools would read settings of the workspace:\n{_shown(files, folder)}Trust them? [y/N] "
            if ask is None or not ask(question):
                tell(f"tools run without settings files of the workspace until `roslens trust`: {_few(files, folder)}")
                return configuration
            trust_settings(configuration, environment, root)
    tools = msgspec.structs.replace(configuration.source.tools, own_settings=True)
    source = msgspec.structs.replace(configuration.source, tools=tools)
    return msgspec.structs.replace(configuration, source=source)


@cache
def _names() -> frozenset[str]:
    """Return the names of all settings files that tools of roslens read."""
    from roslens.source.tools.table import tool_named
    from roslens.source.tools.used import TOOLS

    return frozenset(name for tool in TOOLS for name in tool_named(tool).settings_files)


def _shown(files: tuple[str, ...], folder: str) -> str:
    return "".join(f"  {os.path.relpath(file, folder)}\n" for file in files)


def _few(files: tuple[str, ...], folder: str) -> str:
    first = [os.path.relpath(file, folder) for file in files[:3]]
    return ", ".join(first) + (f" and {len(files) - 3} more" if len(files) > 3 else "")
