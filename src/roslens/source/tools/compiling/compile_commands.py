"""How files are compiled: every ``compile_commands.json`` of a workspace's build folders, as one without side effects.

colcon and catkin leave one for each package, and clang-tidy takes one. Commands come from the folder that is looked at:
only flags that shape what the code means are taken from them, see :mod:`~roslens.source.tools.compiling.compile_flags`.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.source.tools.compiling.compile_flags import allowed_flags, compiler_of

NAME = "compile_commands.json"
MOST_BYTES = 200_000_000
PLACES = (NAME, f"build*/{NAME}", f"build*/*/{NAME}", f".build*/{NAME}", f"*/build*/{NAME}", f"src/build*/{NAME}")
"""Where builds leave them, below the root."""


class Command(msgspec.Struct, frozen=True, omit_defaults=True):
    """An entry as the format defines it."""

    directory: str
    file: str
    arguments: tuple[str, ...] = ()
    command: str = ""


class Database(msgspec.Struct, frozen=True):
    """All entries by the real path of their file, the files they came from, and those that could not be read."""

    commands: dict[str, Command]
    sources: tuple[str, ...] = ()
    unread: tuple[str, ...] = ()


def find_databases(root: str, named: Sequence[str] = ()) -> tuple[Path, ...]:
    """Return the databases of a workspace: those that are named, else those in its build folders."""
    base = Path(root)
    if named:
        return tuple(base / name for name in named)
    found = {path for pattern in PLACES for path in base.glob(pattern) if path.is_file()}
    return tuple(sorted(found))


def merged(paths: Iterable[Path]) -> Database:
    """Read databases into one; of two entries for a file the first of the first counts."""
    commands: dict[str, Command] = {}
    sources: list[str] = []
    unread: list[str] = []
    for path in paths:
        try:
            entries = msgspec.json.decode(read_bounded(path, MOST_BYTES), type=list[Command])
        except (OSError, msgspec.DecodeError) as error:
            unread.append(f"{path}: {error}")
            continue
        sources.append(str(path))
        for entry in entries:
            place = os.path.realpath(os.path.join(entry.directory, entry.file))  # noqa: PTH118
            commands.setdefault(place, harmless(entry, place))
    return Database(commands, tuple(sources), tuple(unread))


def harmless(entry: Command, file: str) -> Command:
    """Return an entry whose arguments only shape what its code means, for the file by its real path."""
    try:
        words = list(entry.arguments) or shlex.split(entry.command)
    except ValueError:
        words = []
    program = compiler_of(words[0] if words else "", file)
    return Command(entry.directory, file, (program, *allowed_flags(words[1:]), file))


def as_json(commands: Mapping[str, Command], files: Iterable[str]) -> bytes:
    """Return a database of the files given, in the format that Clang reads."""
    entries = [commands[file] for file in sorted(files) if file in commands]
    return msgspec.json.encode([{"directory": e.directory, "file": e.file, "arguments": e.arguments} for e in entries])
