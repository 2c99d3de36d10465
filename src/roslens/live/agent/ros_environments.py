"""The processes of this host that have loaded ROS 2, and what their environment says: domain, middleware, discovery.

Two nodes of different domains never meet, and nothing in either of them says so: only who can look into both sees it.
"""

from __future__ import annotations

import stat
from pathlib import Path

import msgspec

from roslens.model.answers.ros_process import RosProcess

SHARED = Path("/dev/shm")  # noqa: S108 - names and rights of files in it are read, no content
_SEGMENTS = ("fastdds_port*", "fastrtps_port*")
_ROUTER = b"rmw_zenohd"
_LIBRARY = b"/librcl.so"
_OBSERVER = b"roslens.live.adapters."
"""What the command line of an observer of roslens has: it makes nothing that anybody waits for."""
_MOST_BYTES = 1 << 20
_LONGEST_COMMAND = 120


class RosEnvironments(msgspec.Struct, frozen=True):
    """What was found.

    Attributes:
        processes: by id.
        unreadable: how many of other users could not be looked into.
        closed_memory: users (numeric ids) who share memory of Fast DDS that others may not write.
        routers: how many routers of Zenoh run.
    """

    processes: tuple[RosProcess, ...] = ()
    unreadable: int = 0
    closed_memory: frozenset[int] = frozenset()
    routers: int = 0


def ros_environments(
    proc: Path = Path("/proc"), without: frozenset[int] = frozenset(), shared: Path = SHARED
) -> RosEnvironments:
    """Return the processes that have loaded a client library of ROS 2.

    Args:
        proc: where the system shows its processes.
        without: processes that are left out, such as the own observers.
        shared: where the system shows memory that processes share.
    """
    found, unreadable, routers = [], 0, 0
    for folder in sorted((one for one in proc.glob("[0-9]*") if one.name.isdecimal()), key=lambda one: int(one.name)):
        pid = int(folder.name)
        if pid in without:
            continue
        try:
            command = _head(folder / "cmdline")
            routers += command.partition(b"\0")[0].endswith(_ROUTER)
            if _LIBRARY not in _head(folder / "maps") or _OBSERVER in command:
                continue
            process = _process(folder, pid)
        except PermissionError:
            unreadable += 1
        except OSError:
            continue  # It ended while it was read.
        else:
            found.append(process)
    return RosEnvironments(tuple(found), unreadable, _closed_memory(shared), routers)


def _closed_memory(shared: Path) -> frozenset[int]:
    """Return the users whose memory of Fast DDS others may not write, as it takes to receive through it."""
    users: dict[int, bool] = {}
    for pattern in _SEGMENTS:
        for segment in shared.glob(pattern):
            try:
                about = segment.stat()
            except OSError:
                continue  # Its process ended.
            is_open = bool(about.st_mode & stat.S_IWOTH)
            users[about.st_uid] = users.get(about.st_uid, False) or is_open
    return frozenset(user for user, is_open in users.items() if not is_open)


def _process(folder: Path, pid: int) -> RosProcess:
    command = _head(folder / "cmdline").replace(b"\0", b" ").decode(errors="replace").strip()
    pairs = (one.partition(b"=") for one in _head(folder / "environ").split(b"\0"))
    variables = {name.decode(errors="replace"): value.decode(errors="replace") for name, _, value in pairs}
    return RosProcess(
        pid, command[:_LONGEST_COMMAND], folder.stat().st_uid, variables.get("ROS_DOMAIN_ID", ""),
        variables.get("RMW_IMPLEMENTATION", ""), variables.get("ROS_AUTOMATIC_DISCOVERY_RANGE", ""),
        variables.get("FASTDDS_BUILTIN_TRANSPORTS", ""),
    )  # fmt: skip


def _head(path: Path) -> bytes:
    with path.open("rb") as stream:
        return stream.read(_MOST_BYTES)
