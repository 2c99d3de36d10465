"""Compressed chunks of recordings, decompressed up to their declared size."""

from __future__ import annotations

import bz2
from collections.abc import Callable
from importlib import import_module
from typing import Any

from roslens.live.adapters.bag.damage import DamageError

LARGEST = 256_000_000
"""Bytes of one chunk; those that recorders write have up to some megabytes."""

UNCHECKED = 16_000_000
"""A chunk of so many bytes may come of any number: a black image is packed to a ten-thousandth."""

RATIO = 1000
"""A larger one has at most so many times the bytes that it is packed in."""

_LZ4_RATIO = 256
_SLACK = 1 << 16


def decompress(content: bytes, compression: str, size: int) -> bytes:
    """Return the content, which was ``size`` bytes before its compression.

    Args:
        content: the compressed bytes.
        compression: ``none`` or empty, ``bz2``, ``lz4`` or ``zstd``.
        size: bytes expected.

    Raises:
        DamageError: the content cannot be unpacked, is not that long, or claims an impossible size.
    """
    found, reason = unpack_start(content, compression, size)
    if reason:
        raise DamageError(reason)
    if len(found) != size:
        raise DamageError(f"a chunk of {len(found):,} bytes with a declared size of {size:,}")
    return found


def most_unpacked(packed: int) -> int:
    """Return how many bytes at most are taken out of ``packed`` ones."""
    return min(LARGEST, max(UNCHECKED, RATIO * packed))


def unpack_start(content: bytes, compression: str, size: int) -> tuple[bytes, str]:
    """Return what can be unpacked from the start of the content, and why it ends early where it does."""
    if compression in {"", "none"}:
        return content, ""
    if why := _unbelievable(len(content), compression, size):
        return b"", why
    unpack = _unpackers().get(compression)
    if unpack is None:
        return b"", f'chunks compressed with "{compression}", which is not supported'
    found = bytearray()
    try:
        _unpack_into(found, content, unpack, size)
    except ImportError as error:
        return b"", f"a chunk compressed with {compression}, and no {error.name} to unpack it"
    except Exception as error:  # noqa: BLE001 - each library has errors of its own
        return bytes(found), f"a chunk that cannot be unpacked: {error}"
    return bytes(found), ""


def _unbelievable(packed: int, compression: str, size: int) -> str:
    """Return why so many bytes cannot come of so many packed ones; empty where they can."""
    if size > LARGEST:
        return f"a chunk with a declared size of {size:,} bytes, more than {LARGEST:,}"
    if size > most_unpacked(packed):
        return f"{packed:,} bytes of {compression} that claim to be {size:,}, more than {RATIO:,} times as many"
    if compression == "lz4" and size > _LZ4_RATIO * packed + _SLACK:
        return f"{packed:,} bytes of lz4 that claim to be {size:,}"
    return ""


def _unpack_into(found: bytearray, content: bytes, unpack: Callable[[], Any], size: int) -> None:
    """Unpack streams that follow each other until there are ``size`` bytes, or one is not complete."""
    rest = content
    while rest and len(found) < size:
        one = unpack()
        piece = one.decompress(rest, size - len(found))
        while piece:
            found += piece
            piece = one.decompress(b"", size - len(found)) if not one.eof and len(found) < size else b""
        if not one.eof:
            return
        rest = one.unused_data or b""


def _unpackers() -> dict[str, Any]:
    return {"bz2": bz2.BZ2Decompressor, "lz4": _lz4, "zstd": _zstd}


def _lz4() -> Any:
    return import_module("lz4.frame").LZ4FrameDecompressor()


def _zstd() -> Any:
    # The same interface: part of Python from 3.14 on, before that from the package that rosbags brings.
    try:
        return import_module("compression.zstd").ZstdDecompressor()
    except ImportError:
        return import_module("backports.zstd").ZstdDecompressor()
