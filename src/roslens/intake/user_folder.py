"""Where roslens keeps what belongs to a user and not to a workspace: a secret, and what the user trusts."""

from __future__ import annotations

import os
import secrets
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path

_SECRET = "secret"  # noqa: S105 - the name of a file
_SECRET_BYTES = 32


def user_folder(environment: Mapping[str, str]) -> Path:
    """Return the folder: ``roslens`` in ``$XDG_CONFIG_HOME``, or in ``~/.config``."""
    home = environment.get("XDG_CONFIG_HOME", "")
    return (Path(home) if os.path.isabs(home) else Path.home() / ".config") / "roslens"  # noqa: PTH117 - may be empty


def write_private(path: Path, content: bytes) -> None:
    """Write a file that only this user can read, whole or not at all.

    Raises:
        OSError: it cannot be written.
    """
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    partial = path.with_name(f".{path.name}.{os.getpid()}")
    partial.unlink(missing_ok=True)
    with os.fdopen(os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as stream:
        stream.write(content)
    partial.replace(path)


def user_secret(environment: Mapping[str, str]) -> bytes:
    """Return 32 bytes that nobody but this user knows; they are made the first time.

    Where no file can be kept, they come from the identity of the machine, which no repository can know either.
    """
    path = user_folder(environment) / _SECRET
    for _ in range(2):
        try:
            kept = path.read_bytes()
            if len(kept) == _SECRET_BYTES:
                return kept
        except OSError:
            pass
        try:
            write_private(path, secrets.token_bytes(_SECRET_BYTES))
        except OSError:
            break
    return sha256(_machine() + str(os.getuid() if hasattr(os, "getuid") else "").encode()).digest()


def _machine() -> bytes:
    for name in ("/etc/machine-id", "/var/lib/dbus/machine-id"):
        try:
            return Path(name).read_bytes()
        except OSError:
            continue
    import uuid

    return uuid.getnode().to_bytes(8, "big")


def state_folder(environment: Mapping[str, str]) -> Path:
    """Return where journals and holds of this user lie: below ``$XDG_STATE_HOME`` or ``~/.local/state``."""
    home = environment.get("XDG_STATE_HOME", "")
    own = os.path.isabs(home)  # noqa: PTH117 - may be empty
    return (Path(home) if own else Path.home() / ".local" / "state") / "roslens"
