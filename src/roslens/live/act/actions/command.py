"""``command``: one that the host has on its allow-list."""

from __future__ import annotations

from roslens.live.act.host import Host
from roslens.model.acting.host_request import HostRequest


def act(host: Host, request: HostRequest) -> str:
    """Run it.

    Raises:
        ActionError: it is not on the list, failed, or did not end in time.
    """
    return host.run(str(request.arguments.get("name", "")))
