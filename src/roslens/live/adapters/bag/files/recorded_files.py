"""Which files a recording is made of, and in which order."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from roslens.intake.bounded_file import read_bounded
from roslens.intake.safe_yaml import load_yaml
from roslens.live.adapters.bag.damage import FailureLog
from roslens.model.errors import UsageError

_SUFFIXES = (".bag", ".bag.active", ".orig.bag", ".mcap", ".db3")
_PACKED = (".zstd", ".zst", ".lz4", ".gz", ".bz2")
_EXPECTED = "a .bag, .mcap or .db3 file, or a folder of them"
_LONGEST_METADATA = 50_000_000
_METADATA = "metadata.yaml"


class RecordedFiles(NamedTuple):
    """Files in the order in which they were recorded; ``compression`` is that of each message on its own."""

    paths: list[Path]
    compression: str = ""


def find_files(path: Path | Sequence[Path], failures: FailureLog) -> RecordedFiles:
    """Return the files of a recording.

    Args:
        path: a file, a folder, or several of them.
        failures: gets what the metadata of a folder promises and what is not there.

    Raises:
        UsageError: a path does not exist, or a folder holds no recording.
    """
    if isinstance(path, Path):
        return _files_of(path, failures)
    found = [_files_of(each, failures) for each in path]
    if not found:
        raise UsageError("no recording is named", expected=_EXPECTED)
    compression = next((each.compression for each in found if each.compression), "")
    unique = dict.fromkeys(file for each in found for file in each.paths)
    return RecordedFiles(list(unique), compression)


def _files_of(path: Path, failures: FailureLog) -> RecordedFiles:
    try:
        if path.is_dir():
            return _folder(path, failures)
        if path.name == _METADATA and path.exists():
            return _folder(path.parent, failures)
        if path.is_file():
            return RecordedFiles([path])
        found = "is not a file" if path.exists() else "does not exist"
    except (OSError, ValueError) as error:
        found = f"cannot be accessed ({getattr(error, 'strerror', None) or error})"
    raise UsageError(f'"{path}" {found}', expected=_EXPECTED, advice="Check the path.")


def _folder(folder: Path, failures: FailureLog) -> RecordedFiles:
    there = sorted(_unpacked_before_packed(folder), key=_natural)
    information = _information(folder / _METADATA, failures)
    named = _named(folder, information.get("relative_file_paths") or [], failures)
    if not named and not there:
        raise UsageError(f'"{folder}" holds no recording', expected=_EXPECTED, advice="Check the path.")
    mode = str(information.get("compression_mode") or "").lower()
    kind = str(information.get("compression_format") or "").lower()
    return RecordedFiles(named or there, kind if mode == "message" else "")


def _unpacked_before_packed(folder: Path) -> Iterable[Path]:
    """Return the recordings in a folder; of one that is there packed as a whole too, the one that is not."""
    files = list(folder.iterdir())
    packed = {file.stem: file for file in files if file.suffix in _PACKED and file.stem.endswith(_SUFFIXES)}
    return {**packed, **{file.name: file for file in files if file.name.endswith(_SUFFIXES)}}.values()


def _named(folder: Path, entries: Iterable[object], failures: FailureLog) -> list[Path]:
    """Return the files that the metadata name and that are there, unpacked where they are so."""
    named = []
    for entry in entries:
        file = _within(folder, str(entry))
        if file.suffix in _PACKED:
            file = file.with_suffix("") if file.with_suffix("").is_file() else file
        if file.is_file():
            named.append(file)
        else:
            what = f'"{entry}", which {_METADATA} names, is not there'
            failures.add(folder / _METADATA, what, advice="The other files are read.")
    return named


def _within(folder: Path, entry: str) -> Path:
    """Return a file that metadata names; files were moved together with their folder, so only the name counts else."""
    file = folder / entry
    return file if file.is_file() else folder / Path(entry).name


def _information(path: Path, failures: FailureLog) -> dict[str, Any]:
    if not path.is_file():
        return {}
    try:
        information = load_yaml(read_bounded(path, _LONGEST_METADATA))["rosbag2_bagfile_information"]
        named = information.get("relative_file_paths") or []
        reason = "" if isinstance(named, list) else "no list of files"
    except (OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
        information, reason = {}, f"{type(error).__name__}: {error}"
    if reason:
        what = f"metadata that cannot be read: {' '.join(reason.split())}"
        failures.add(path, what, advice="The files of the folder are read. `ros2 bag reindex` writes it anew.")
        return {}
    found: dict[str, Any] = information
    return found


def _natural(path: Path) -> list[tuple[int, int, str]]:
    """Return a key that puts part 10 behind part 9."""
    pieces = re.split(r"(\d+)", path.name)
    return [(0, int(piece), "") if piece.isdecimal() else (1, 0, piece) for piece in pieces]
