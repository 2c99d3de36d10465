"""How files are compiled: every ``compile_commands.json`` of a workspace's build folders, as one without side effects.

colcon and catkin leave one for each package, and clang-tidy takes one. Commands come from the folder that is looked at:
what would load code into the compiler is left out of them.
"""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded

NAME = "compile_commands.json"
MOST_BYTES = 200_000_000
PLACES = (NAME, f"build*/{NAME}", f"build*/*/{NAME}", f".build*/{NAME}", f"*/build*/{NAME}", f"src/build*/{NAME}")
"""Where builds leave them, below the root."""

LOADS = ("-fplugin", "-fpass-plugin", "-specs", "--specs", "-load", "-plugin", "-add-plugin", "--config", "-B", "@")
"""How arguments begin by which a compiler loads or runs something."""


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
    """Return an entry with a list of arguments, without those that load code, and with the real path of its file."""
    try:
        words = list(entry.arguments) or shlex.split(entry.command)
    except ValueError:
        words = []
    return Command(entry.directory, file, tuple(_kept(words)))


def _kept(words: Sequence[str]) -> Iterator[str]:
    at = 0
    while at < len(words):
        left_out = _left_out(words, at) if at else 0
        if not left_out:
            yield words[at]
        at += left_out or 1


def _left_out(words: Sequence[str], at: int) -> int:
    """Return how many words from one on would load something into the compiler."""
    word, *after = words[at : at + 3]
    if word == "-Xclang" and after and after[0].startswith(LOADS):
        # What it loads, or the option of a plug-in, comes as a second pair.
        return 4 if after[1:] == ["-Xclang"] and at + 3 < len(words) else 2
    if not word.startswith(LOADS):
        return 0
    return 2 if word in LOADS and word != "@" else 1


def as_json(commands: Mapping[str, Command], files: Iterable[str]) -> bytes:
    """Return a database of the files given, in the format that Clang reads."""
    entries = [commands[file] for file in sorted(files) if file in commands]
    return msgspec.json.encode([{"directory": e.directory, "file": e.file, "arguments": e.arguments} for e in entries])
