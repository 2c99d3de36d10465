"""Keys of results: equal keys mean equal inputs, so that a known result can be used again."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from hashlib import blake2b, sha1
from pathlib import Path

import msgspec

import roslens


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


def _shaping_files(package: Path) -> Iterable[Path]:
    for layer in ("model", "plugins", "judge", "source"):
        for suffix in ("py", "yaml", "toml"):
            yield from sorted((package / layer).rglob(f"*.{suffix}"))


def _hash_of(files: Iterable[Path]) -> str:
    digest = blake2b(digest_size=6)
    for file in files:
        digest.update(file.name.encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()
