"""The processes of this host that have loaded ROS 2, and what their environment says: domain, middleware, discovery.

Two nodes of different domains never meet, and nothing in either of them says so: only who can look into both sees it.
"""

from __future__ import annotations

from pathlib import Path

import msgspec

from roslens.model.answers.ros_process import RosProcess

_LIBRARY = b"/librcl.so"
_OBSERVER = b"roslens.live.adapters."
"""What the command line of an observer of roslens has: it makes nothing that anybody waits for."""
_MOST_BYTES = 1 << 20
_LONGEST_COMMAND = 120


class RosEnvironments(msgspec.Struct, frozen=True):
    """What was found: processes by id, and how many of other users could not be looked into."""

    processes: tuple[RosProcess, ...] = ()
    unreadable: int = 0


def ros_environments(proc: Path = Path("/proc"), without: frozenset[int] = frozenset()) -> RosEnvironments:
    """Return the processes that have loaded a client library of ROS 2.

    Args:
        proc: where the system shows its processes.
        without: processes that are left out, such as the own observers.
    """
    found, unreadable = [], 0
    for folder in sorted((one for one in proc.glob("[0-9]*") if one.name.isdecimal()), key=lambda one: int(one.name)):
        pid = int(folder.name)
        if pid in without:
            continue
        try:
            if _LIBRARY not in _head(folder / "maps") or _OBSERVER in _head(folder / "cmdline"):
                continue
            process = _process(folder, pid)
        except PermissionError:
            unreadable += 1
        except OSError:
            continue  # It ended while it was read.
        else:
            found.append(process)
    return RosEnvironments(tuple(found), unreadable)


def _process(folder: Path, pid: int) -> RosProcess:
    command = _head(folder / "cmdline").replace(b"\0", b" ").decode(errors="replace").strip()
    pairs = (one.partition(b"=") for one in _head(folder / "environ").split(b"\0"))
    variables = {name.decode(errors="replace"): value.decode(errors="replace") for name, _, value in pairs}
    return RosProcess(
        pid, command[:_LONGEST_COMMAND], folder.stat().st_uid, variables.get("ROS_DOMAIN_ID", ""),
        variables.get("RMW_IMPLEMENTATION", ""), variables.get("ROS_AUTOMATIC_DISCOVERY_RANGE", ""),
    )  # fmt: skip


def _head(path: Path) -> bytes:
    with path.open("rb") as stream:
        return stream.read(_MOST_BYTES)
