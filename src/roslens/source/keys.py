"""Keys of results: equal keys mean equal inputs, so that a known result can be used again."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from functools import cache
from hashlib import blake2b, sha1
from pathlib import Path

import msgspec

import roslens

_SUFFIXES = (".py", ".yaml", ".toml")


def content_hash(content: bytes) -> str:
    """Return git's blob id of the content, so that ``git ls-files -s`` provides it for free."""
    return sha1(b"blob %d\0" % len(content) + content, usedforsecurity=False).hexdigest()


def key_of(*parts: object) -> str:
    """Return 32 hexadecimal digits for values that msgspec can encode; their order counts."""
    digest = blake2b(digest_size=16)
    for part in parts:
        digest.update(msgspec.msgpack.encode(part, order="sorted"))
        digest.update(b"\0")
    return digest.hexdigest()


@cache
def analyser_version() -> str:
    """Return roslens' version with a hash of the code and data that shape results.

    A result of other code is never taken for one of this code, even between two releases.
    """
    package = Path(roslens.__file__).parent
    return f"{roslens.__version__}+{_hash_of(_shaping_files(package))}"


def _shaping_files(package: Path) -> Iterator[str]:
    """Yield the paths of code and data, sorted within each folder."""
    for layer in ("model", "plugins", "judge", "source", "cli/graph"):
        for folder, folders, names in os.walk(package / layer):
            folders.sort()
            yield from (f"{folder}/{name}" for name in sorted(names) if name.endswith(_SUFFIXES))


def _hash_of(files: Iterable[str]) -> str:
    digest = blake2b(digest_size=6)
    for path in files:
        digest.update(path.rpartition("/")[2].encode())
        # Over a thousand small files, with each command: a buffer for each would take a third of the time.
        with open(path, "rb", buffering=0) as file:  # noqa: PTH123
            digest.update(file.read())
    return digest.hexdigest()
