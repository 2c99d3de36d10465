"""Where this observer stands, and what of the graph stands on the same host."""

from __future__ import annotations

import os
import socket
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

_LISTENING = "0A"


def own_address(environment: Mapping[str, str], towards: str, port: int) -> str:
    """Return the name or address by which others reach us, chosen as ROS nodes choose it.

    Args:
        environment: in which ROS_HOSTNAME or ROS_IP may say it.
        towards: address of the master; the interface that leads there is the one that others reach.
        port: of the master.
    """
    given = environment.get("ROS_HOSTNAME") or environment.get("ROS_IP")
    if given:
        return given
    family = socket.AF_INET6 if ":" in towards else socket.AF_INET
    with suppress(OSError), socket.socket(family, socket.SOCK_DGRAM) as probe:
        probe.connect((towards, port))  # a datagram socket sends nothing to connect; it only picks its interface
        return str(probe.getsockname()[0])
    return "127.0.0.1"


def is_local(address: str) -> bool:
    """Whether an address is one of this host."""
    family = socket.AF_INET6 if ":" in address else socket.AF_INET
    with suppress(OSError), socket.socket(family, socket.SOCK_STREAM) as probe:
        probe.bind((address, 0))
        return True
    return False


def owns_port(pid: int, port: int, proc: Path = Path("/proc")) -> bool | None:
    """Whether a process listens at a TCP port; None where this may not be seen.

    A process number that a node tells from inside a container names another process out here, which this finds out.
    """
    inodes = set()
    for table in ("tcp", "tcp6"):
        with suppress(OSError):
            for line in (proc / str(pid) / "net" / table).read_text().splitlines()[1:]:
                fields = line.split()
                if len(fields) > 9 and fields[3] == _LISTENING and int(fields[1].rpartition(":")[2], 16) == port:
                    inodes.add(f"socket:[{fields[9]}]")
    try:
        files = os.listdir(proc / str(pid) / "fd")  # noqa: PTH208
    except FileNotFoundError:
        return False
    except OSError:
        return None
    for file in files:
        with suppress(OSError):
            if os.readlink(proc / str(pid) / "fd" / file) in inodes:  # noqa: PTH115
                return True
    return False
