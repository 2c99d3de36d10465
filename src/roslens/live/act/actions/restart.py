"""``restart``: the process of a node ends, and is started as it was."""

from __future__ import annotations

from roslens.live.act.ending import ask_to_end, kill, refuse_shared
from roslens.live.act.host import Host, Known, seconds
from roslens.live.act.ros import ActionError
from roslens.model.acting.host_request import HostRequest

RESPAWN_S = 2.0
"""So long what supervises a process has to start it again before it is started from here."""


def act(host: Host, request: HostRequest) -> str:
    """End the process and start it again.

    Raises:
        ActionError: it holds other nodes, does not end, or cannot be started.
    """
    refuse_shared(request)
    process = host.process(request)
    grace_s = seconds(request.arguments, "grace", 5.0)
    kill_after_s = seconds(request.arguments, "kill_after", 5.0)
    how = ask_to_end(host, process, grace_s)
    if not how:
        if not kill_after_s:
            raise ActionError(f"process {process.pid} is still there {grace_s:g} s after it was asked to end")
        how = "ended late" if host.ends(process, kill_after_s) else kill(host, process)
    return f"process {process.pid} {how}; {started_again(host, process, request.node)}"


def started_again(host: Host, process: Known, node: str) -> str:
    """Start a process that is gone, unless what supervises it does; return what was done.

    Raises:
        ActionError: it cannot be started.
    """
    wait_s = RESPAWN_S if process.supervisor else 0.0
    if pid := host.comes_back(process, wait_s):
        return f"{process.supervisor or 'another process'} started it again as process {pid}"
    return f"started again as process {host.start(process, node)}"
