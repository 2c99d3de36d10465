"""One `roslens react` that acts for each ROS system of a host: two would each restart what is gone.

The lock is a Unix socket with an abstract name (``unix(7)``): it ends with its process, however that ends, nobody has
to delete a file, and whoever finds it taken learns from the kernel which process has it. Its names are those of a
network namespace, as are the domains and masters that it is about.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import socket
import struct
from collections.abc import Iterable
from pathlib import Path

from roslens.model.errors import UsageError

_CREDENTIALS = struct.Struct("3i")
_SHOWN = 200


def system_of(tool: str, options: argparse.Namespace) -> str:
    """Return which system an observer of ROS observes, in words that are the same for all observers of it."""
    if tool == "ros1":
        return f"master {options.master or os.environ.get('ROS_MASTER_URI', '') or 'http://localhost:11311'}"
    domain = options.domain if options.domain is not None else os.environ.get("ROS_DOMAIN_ID", "") or 0
    return f"ROS domain {domain}"


def hold_alone(stack: contextlib.ExitStack, systems: Iterable[str]) -> None:
    """Be the only one that acts on some systems (``domain 61``, ``master http://…``) until the stack ends.

    Raises:
        UsageError: another process acts on one of them.
    """
    for system in systems:
        held = stack.enter_context(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM))
        name = f"\0roslens react {system}"[:100]
        try:
            held.bind(name)
        except OSError:
            raise UsageError(
                f"{_holder(name)} acts on {system} of this host already",
                expected="one `roslens react` that acts on it: two would each start again what is gone",
                advice="End the other one, or give --mode dry-run",
            ) from None
        held.listen(1)


def _holder(name: str) -> str:
    """Return who has the name, as far as the kernel tells."""
    with contextlib.suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as asking:
        asking.settimeout(1.0)
        asking.connect(name)
        pid, uid, _ = _CREDENTIALS.unpack(asking.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, _CREDENTIALS.size))
        if pid == os.getpid():
            return "this process"
        return f"process {pid} of user {uid}{_command(pid)}"
    return "another process"


def _command(pid: int) -> str:
    try:
        words = (Path("/proc") / str(pid) / "cmdline").read_bytes().rstrip(b"\0").split(b"\0")
    except OSError:
        return ""
    text = " ".join(b" ".join(words).decode("utf-8", "replace").split())
    return f" (`{text[:_SHOWN]}`)" if text else ""
