"""Ending processes: by SIGINT, then SIGTERM, and by SIGKILL only if the action is to kill."""

from __future__ import annotations

import signal

from roslens.live.act.host import Host, Known
from roslens.live.act.ros import ActionError
from roslens.model.acting.host_request import HostRequest

KILLED_WITHIN_S = 5.0


def ask_to_end(host: Host, process: Known, grace_s: float) -> str:
    """Send SIGINT, and SIGTERM half of the grace later; return how it ended, empty where it did not."""
    if not host.alive(process):
        return "had ended before"
    host.signal(process, signal.SIGINT)
    if host.ends(process, grace_s / 2):
        return "ended on SIGINT"
    host.signal(process, signal.SIGTERM)
    return "ended on SIGTERM" if host.ends(process, grace_s / 2) else ""


def kill(host: Host, process: Known) -> str:
    """Send SIGKILL and wait for the end.

    Raises:
        ActionError: it is still there; the kernel waits for a device.
    """
    host.signal(process, signal.SIGKILL)
    if not host.ends(process, KILLED_WITHIN_S):
        raise ActionError(f"process {process.pid} was killed and is still there: the kernel waits for a device")
    return "was killed"


def refuse_shared(request: HostRequest) -> None:
    """Leave a process alone that holds other nodes too, unless that was allowed.

    Raises:
        ActionError: it holds others.
    """
    if request.beside and not request.arguments.get("whole_process"):
        others = ", ".join(request.beside[:5])
        raise ActionError(
            f"process {request.pid} holds {others} too", expected=f"{request.node} alone",
            advice="`whole_process: true` lets these end with it",
        )  # fmt: skip
