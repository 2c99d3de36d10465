"""What the last fix changed, kept so that it can be taken back."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import MOST_DOCUMENT_BYTES, read_bounded
from roslens.model.errors import UsageError
from roslens.source.fix.mended_files import MendedFile
from roslens.source.fix.write_files import WriteFault, write_files
from roslens.source.keys import content_hash

FILE_NAME = "last-fix.json"
SCHEMA = "roslens-last-fix/1"


class Changed(msgspec.Struct, frozen=True):
    """A file below the workspace: its content before, and git's blob id of what the fix made of it."""

    path: str
    before: bytes
    after: str


class LastFix(msgspec.Struct, frozen=True):
    """The files that a fix changed, each once."""

    schema: str
    files: tuple[Changed, ...]


def keep_last_fix(files: Sequence[MendedFile], place: Path, earlier: LastFix | None = None) -> LastFix:
    """Keep what files were before they are written, and return it.

    Args:
        files: that are going to be changed.
        place: of the record.
        earlier: what the same fix changed already; a file that is in it keeps what it was at first.

    Raises:
        OSError: it cannot be kept.
    """
    first = {one.path: one.before for one in (earlier.files if earlier else ())}
    known = {one.path: one for one in (earlier.files if earlier else ())}
    for file in files:
        known[file.path] = Changed(file.path, first.get(file.path, file.before), content_hash(file.after))
    record = LastFix(SCHEMA, tuple(known[path] for path in sorted(known)))
    part = place.with_name(f"{place.name}.part")
    part.write_bytes(msgspec.json.encode(record))
    part.replace(place)
    return record


def take_back(place: Path, root: Path) -> tuple[tuple[str, ...], tuple[WriteFault, ...]]:
    """Give files the content that they had before the last fix.

    What was taken back is no longer in the record.

    Args:
        place: of the record.
        root: of the workspace.

    Returns:
        The paths that are as they were, and what could not be taken back.

    Raises:
        UsageError: there is nothing to take back, or the record cannot be read.
    """
    record = _read(place)
    wanted: list[MendedFile] = []
    done: list[str] = []
    faults: list[WriteFault] = []
    for one in record.files:
        now = _content(root / one.path)
        if now == one.before:
            done.append(one.path)
        elif now is None or content_hash(now) != one.after:
            faults.append(_changed(one, gone=now is None))
        else:
            wanted.append(MendedFile(one.path, now, one.before))
    written, unwritten = write_files(wanted, root)
    done += [file.path for file in written]
    left = tuple(one for one in record.files if one.path not in done)
    if left:
        place.write_bytes(msgspec.json.encode(LastFix(SCHEMA, left)))
    else:
        place.unlink(missing_ok=True)
    return tuple(sorted(done)), (*faults, *unwritten)


def _read(place: Path) -> LastFix:
    try:
        record = msgspec.json.decode(read_bounded(place, MOST_DOCUMENT_BYTES), type=LastFix)
    except FileNotFoundError:
        raise UsageError(
            "there is no fix to undo", where=str(place), expected="a workspace on which `roslens check --fix` ran"
        ) from None
    except (OSError, msgspec.DecodeError) as error:
        raise UsageError(
            f"the record of the last fix cannot be read: {error}",
            where=str(place),
            expected="what `roslens check --fix` wrote",
            advice="Undo the changes by version control: `git diff` shows them",
        ) from error
    if any(not _is_inside(one.path) for one in record.files) or record.schema != SCHEMA:
        raise UsageError("the record of the last fix is of another version", where=str(place), expected=SCHEMA)
    return record


def _is_inside(path: str) -> bool:
    return not path.startswith("/") and ".." not in path.split("/")


def _content(path: Path) -> bytes | None:
    try:
        return read_bounded(path)
    except OSError:
        return None


def _changed(one: Changed, *, gone: bool) -> WriteFault:
    from roslens.model.failure import Failure
    from roslens.model.source import Location
    from roslens.source.fix.write_files import TOOL

    what = "it is gone since the fix" if gone else "it changed since the fix"
    failure = Failure(
        TOOL,
        f"{what} and is left as it is",
        "the file as the fix left it",
        "Undo the change by hand, or by version control",
        Location(one.path),
        entity=f"file:{one.path}",
    )
    return WriteFault(MendedFile(one.path, b"", one.before), failure)
