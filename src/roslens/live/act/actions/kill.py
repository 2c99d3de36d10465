"""``kill``: the process of a node is asked to end, and killed where it does not."""

from __future__ import annotations

from roslens.live.act.ending import ask_to_end, kill, refuse_shared
from roslens.live.act.host import Host, seconds
from roslens.model.acting.host_request import HostRequest


def act(host: Host, request: HostRequest) -> str:
    """End the process.

    Raises:
        ActionError: it holds other nodes, or cannot even be killed.
    """
    refuse_shared(request)
    process = host.process(request)
    how = ask_to_end(host, process, seconds(request.arguments, "grace", 5.0))
    return f"process {process.pid} {how or kill(host, process)}"
