"""The file with the key that agents and monitor share."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from roslens.live.agent.link import MIN_KEY_BYTES
from roslens.model.errors import UsageError

KEY_BYTES = 32


def write_key(path: Path) -> None:
    """Write a new key that only the user can read.

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
        stream.write(secrets.token_hex(KEY_BYTES) + "\n")


def read_key(path: Path) -> bytes:
    """Return the key in a file.

    Raises:
        UsageError: it cannot be read, holds too little, or others can read it.
    """
    advice = f"Make one with `roslens agent --make-key {path}` and copy it to each host"
    try:
        key = path.read_bytes().strip()
        others = path.stat().st_mode & 0o077
    except OSError as error:
        raise UsageError(
            f"cannot read the key: {error.strerror or error}", where=str(path), expected="a key file", advice=advice
        ) from None
    if len(key) < MIN_KEY_BYTES:
        raise UsageError(
            f"a key of {len(key)} bytes", where=str(path), expected=f"at least {MIN_KEY_BYTES}", advice=advice
        )
    if others:
        raise UsageError(
            "others can read the key", where=str(path), expected="a file for you alone", advice=f"chmod 600 {path}"
        )
    return key
