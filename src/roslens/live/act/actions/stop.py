"""``stop``: the process of a node is asked to end, and never killed."""

from __future__ import annotations

from roslens.live.act.ending import ask_to_end, refuse_shared
from roslens.live.act.host import Host, seconds
from roslens.live.act.ros import ActionError
from roslens.model.acting.host_request import HostRequest

_LOOKED_S = 1.0


def act(host: Host, request: HostRequest) -> str:
    """Ask the process to end.

    Raises:
        ActionError: it holds other nodes, or is still there.
    """
    refuse_shared(request)
    process = host.process(request)
    grace_s = seconds(request.arguments, "grace", 5.0)
    how = ask_to_end(host, process, grace_s)
    if not how:
        raise ActionError(f"process {process.pid} is still there {grace_s:g} s after it was asked to end")
    if process.supervisor and (pid := host.comes_back(process, _LOOKED_S)):
        raise ActionError(
            f"process {process.pid} {how}, and {process.supervisor} started it again as {pid}",
            advice="What supervises it has to be informed, for instance by a command of the allow-list",
        )
    return f"process {process.pid} {how}"
