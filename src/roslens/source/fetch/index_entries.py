"""Links and submodules of a checkout, from git's own list of its files: another process would take longer.

The format is that of ``gitformat-index(5)``, version 2 and 3; git is told to write no other.
"""

from __future__ import annotations

import struct
from pathlib import Path

import msgspec

from roslens.intake.bounded_file import MOST_DOCUMENT_BYTES, read_bounded

_HEADER = struct.Struct(">4sLL")
_MODE, _ID, _FLAGS, _NAME = 24, 40, 60, 62
_EXTENDED = 0x4000
_LINK, _SUBMODULE = 0o120000, 0o160000


class IndexFormatError(ValueError):
    """The list is none that git writes here."""


class Entries(msgspec.Struct, frozen=True):
    """Paths of links, and submodules: their paths, each with its commit."""

    links: tuple[str, ...]
    submodules: tuple[tuple[str, str], ...]


def index_entries(folder: Path) -> Entries:
    """Return the links and submodules of a clone, in order of their paths.

    Raises:
        IndexFormatError: its list of files is of no known format.
        OSError: it cannot be read.
    """
    content = read_bounded(folder / ".git" / "index", MOST_DOCUMENT_BYTES)
    try:
        return _entries(content)
    except (struct.error, ValueError, IndexError) as error:
        raise IndexFormatError(f"the index of git cannot be read: {error}") from error


def _entries(content: bytes) -> Entries:
    signature, version, count = _HEADER.unpack_from(content)
    if signature != b"DIRC" or version not in (2, 3):
        raise IndexFormatError(f"version {version}")
    links: list[str] = []
    submodules: list[tuple[str, str]] = []
    at = _HEADER.size
    for _ in range(count):
        (kind,) = struct.unpack_from(">L", content, at + _MODE)
        (flags,) = struct.unpack_from(">H", content, at + _FLAGS)
        begin = at + _NAME + (2 if flags & _EXTENDED else 0)
        end = content.index(b"\0", begin)
        if kind & 0o170000 in (_LINK, _SUBMODULE):
            path = content[begin:end].decode("utf-8", "surrogateescape")
            if kind & 0o170000 == _LINK:
                links.append(path)
            else:
                submodules.append((path, content[at + _ID : at + _FLAGS].hex()))
        # Entries are padded by one to eight zeros to a multiple of eight.
        at += (end - at + 8) & ~7
    return Entries(tuple(links), tuple(submodules))
