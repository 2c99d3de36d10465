"""The file with the key that agents and monitor share."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from roslens.live.agent.key_strength import RANDOM_BITS, weakness
from roslens.model.errors import UsageError

_MOST_BYTES = 4096
"""Nothing behind so many bytes of a file is read."""


def write_key(path: Path) -> None:
    """Write a new key of 256 random bits that only the user can read.

    Raises:
        UsageError: there is a file already.
        OSError: the file cannot be written.
    """
    try:
        file = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    except FileExistsError:
        raise UsageError(
            "there is a file already", where=str(path), advice="Take another name, or remove it if no agent uses it"
        ) from None
    with os.fdopen(file, "w", encoding="ascii") as stream:
        stream.write(secrets.token_hex(RANDOM_BITS // 8) + "\n")


def read_key(path: Path) -> bytes:
    """Return the key in a file.

    Raises:
        UsageError: it cannot be read, is nothing random, or others can read it.
    """
    advice = f"Make one with `roslens agent --new-key {path}` and copy it to each host"
    try:
        with path.open("rb") as file:
            content = file.read(_MOST_BYTES)
            others = os.fstat(file.fileno()).st_mode & 0o077
    except OSError as error:
        raise UsageError(
            f"cannot read the key: {error.strerror or error}", where=str(path), expected="a key file", advice=advice
        ) from None
    # Bytes that are no text may begin or end with what would be space in one.
    key = content.strip() if content.isascii() else content
    if weak := weakness(key):
        raise UsageError(weak, where=str(path), expected=f"{RANDOM_BITS} random bits", advice=advice)
    if others:
        raise UsageError(
            "others can read the key", where=str(path), expected="a file for you alone", advice=f"chmod 600 {path}"
        )
    return key
