"""Files that were packed as a whole (`ros2 bag record --compression-mode file`, gzip), unpacked to be read."""

from __future__ import annotations

import errno
import shutil
import tempfile
import weakref
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import IO, Any, NamedTuple

from roslens.live.adapters.bag.damage import FailureLog
from roslens.live.adapters.bag.decompress import RATIO, UNCHECKED
from roslens.model.errors import UsageError

KEPT_FREE = 1_000_000_000
"""Bytes of the disk that are left to others."""
_PIECE = 1 << 20
_KINDS = {b"\x28\xb5\x2f\xfd": "zstd", b"\x1f\x8b": "gzip", b"\x04\x22\x4d\x18": "lz4", b"BZh": "bz2"}


class Scratch:
    """A temporary folder, which is removed when nobody refers to this any more."""

    def __init__(self) -> None:
        self.path = Path(tempfile.mkdtemp(prefix="roslens-unpacked-"))
        weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)


class Unpacked(NamedTuple):
    """A file as it was before it was packed, in a folder that is there as long as somebody refers to it."""

    path: Path
    folder: Scratch


def unpack(path: Path, failures: FailureLog, free: Callable[[Path], int] | None = None) -> Unpacked | None:
    """Return what a file holds that is packed as a whole; None of one that is not.

    Where it is damaged or cut off, what comes before that is returned, and ``failures`` get the reason.

    Args:
        path: of the file.
        failures: get what is lost.
        free: returns how many bytes of the disk of a folder are free.

    Raises:
        UsageError: nothing can be unpacked, or it takes more room than there is, or than such a file may.
        OSError: the file cannot be read.
    """
    with path.open("rb") as file:
        head = file.read(4)
    kind = next((kind for magic, kind in _KINDS.items() if head.startswith(magic)), "")
    if not kind:
        return None
    folder = Scratch()
    into = folder.path / path.stem
    room = (free or _free)(folder.path) - KEPT_FREE
    most = min(room, max(UNCHECKED, RATIO * path.stat().st_size))
    try:
        with _opened(path, kind) as packed, into.open("wb") as out:
            _copy(packed, out, path, most, room)
    except UsageError:
        raise
    except ImportError as error:
        raise UsageError(
            f"a file packed with {kind}, and no {error.name} to unpack it", where=str(path), advice="Unpack it."
        ) from None
    except Exception as error:  # noqa: BLE001 - each library has errors of its own
        if isinstance(error, OSError) and error.errno == errno.ENOSPC:
            raise _no_room(path, into.stat().st_size) from None
        what = f"packed with {kind}, and cannot be unpacked to its end: {str(error) or type(error).__name__}"
        advice = "Check that it was copied completely."
        if not into.stat().st_size:
            raise UsageError(what, where=str(path), expected="a whole file", advice=advice) from None
        failures.add(path, what, expected="a whole file", advice=f"What comes before is read. {advice}")
    return Unpacked(into, folder)


def _copy(packed: IO[bytes], out: IO[bytes], path: Path, most: int, room: int) -> None:
    size = 0
    while piece := packed.read(_PIECE):
        size += len(piece)
        if size > most:
            if most == room:
                raise _no_room(path, size)
            raise UsageError(
                f"unpacks to more than {RATIO:,} times its size", where=str(path), expected="a packed recording",
                advice="Unpack it yourself if that is right.",
            )  # fmt: skip
        out.write(piece)


def _no_room(path: Path, size: int) -> UsageError:
    folder = tempfile.gettempdir()
    return UsageError(
        f"unpacks to more than the {size:,} bytes for which there is room in {folder}", where=str(path),
        expected=f"room for it, and for {KEPT_FREE:,} bytes of others",
        advice="Name a folder with more room in $TMPDIR, or unpack it yourself.",
    )  # fmt: skip


def _free(folder: Path) -> int:
    return shutil.disk_usage(folder).free


def _opened(path: Path, kind: str) -> Any:
    if kind == "zstd":
        # Part of Python from 3.14 on, before that from the package that rosbags brings.
        try:
            module = import_module("compression.zstd")
        except ImportError:
            module = import_module("backports.zstd")
    else:
        module = import_module("lz4.frame" if kind == "lz4" else kind)
    return module.open(path, "rb")
