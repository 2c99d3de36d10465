"""Files of a workspace replaced whole: never one that changed meanwhile, never half a file."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import read_bounded
from roslens.model.failure import Failure
from roslens.model.source import Location
from roslens.source.fix.mended_files import MendedFile

TOOL = "fix"


class WriteFault(msgspec.Struct, frozen=True):
    """A file that was left as it is, and why."""

    file: MendedFile
    failure: Failure


def write_files(files: Iterable[MendedFile], root: Path) -> tuple[tuple[MendedFile, ...], tuple[WriteFault, ...]]:
    """Put the new contents of files in their places; return those that are written and those that are not.

    The content is written beside the file and takes its name; mode and, where that is allowed, owner stay. What a link
    leads to is replaced, not the link.

    Args:
        files: with what is on the disk, and what is to be there.
        root: of the workspace.
    """
    written: list[MendedFile] = []
    faults: list[WriteFault] = []
    for file in files:
        try:
            _replace((root / file.path).resolve(), file)
            written.append(file)
        except _RefusedError as error:
            faults.append(WriteFault(file, _failure(file, error.what, error.advice)))
        except OSError as error:
            advice = "Make room, or check who may write to its folder"
            faults.append(WriteFault(file, _failure(file, f"it cannot be written, {error.strerror}", advice)))
    return tuple(written), tuple(faults)


class _RefusedError(Exception):
    def __init__(self, what: str, advice: str) -> None:
        super().__init__(what)
        self.what = what
        self.advice = advice


def _replace(place: Path, file: MendedFile) -> None:
    mode = stat.S_IMODE(place.stat().st_mode)
    # The owner could replace it all the same, and root write to it: who took the right away meant something.
    if not mode & 0o222 or not os.access(place, os.W_OK):
        raise _RefusedError("it is read-only", f"Run `chmod u+w {file.path}` first, or leave it as it is")
    part = place.with_name(f".{place.name}.{os.getpid()}.roslens")
    try:
        _write(part, file.after, mode)
        owner = place.stat()
        with suppress(OSError):
            os.chown(part, owner.st_uid, owner.st_gid)
            part.chmod(mode)
        if read_bounded(place) != file.before:
            raise _RefusedError("it changed since it was read", "Run the same command again")
        part.replace(place)
    finally:
        part.unlink(missing_ok=True)


def _write(part: Path, content: bytes, mode: int) -> None:
    descriptor = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o600)
    with os.fdopen(descriptor, "wb") as stream:
        stream.write(content)
        stream.flush()
        os.fsync(stream.fileno())
    part.chmod(mode)


def _failure(file: MendedFile, what: str, advice: str) -> Failure:
    return Failure(TOOL, what, "a file that can be fixed", advice, Location(file.path), entity=f"file:{file.path}")
