"""``start``: a node that is gone is started as it was."""

from __future__ import annotations

from roslens.live.act.actions.restart import started_again
from roslens.live.act.host import Host
from roslens.model.acting.host_request import HostRequest


def act(host: Host, request: HostRequest) -> str:
    """Start the process, unless it runs.

    Raises:
        ActionError: nobody knows how it was started, or it cannot be.
    """
    process = host.process(request)
    if host.alive(process):
        return f"process {process.pid} runs already"
    return started_again(host, process, request.node)
