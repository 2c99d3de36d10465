"""States of managed nodes, requested from those that offer the service."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from roslens.model.graph import Endpoint, Role

TYPE = "lifecycle_msgs/srv/GetState"
_SERVICE = "/get_state"


def managed(endpoints: Iterable[Endpoint]) -> dict[str, str]:
    """Return the nodes that offer their state, with the service for it."""
    return {
        end.node: end.name
        for end in endpoints
        if end.role is Role.SERVICE_SERVER and end.type == TYPE and end.name == end.node + _SERVICE
    }


class Lifecycles:
    """Asks without waiting: what was asked is taken up when it is there.

    Args:
        connect: makes a client of a service; it has ``ask()``, ``answer()`` and ``close()``.
    """

    def __init__(self, connect: Callable[[str], Any]) -> None:
        self._connect = connect
        self._clients: dict[str, Any] = {}
        self._states: dict[str, str] = {}

    def follow(self, endpoints: Iterable[Endpoint]) -> None:
        """Ask these from now on and no others."""
        services = managed(endpoints)
        for name in self._clients.keys() - services.keys():
            self._clients.pop(name).close()
            self._states.pop(name, None)
        for name in services.keys() - self._clients.keys():
            self._clients[name] = self._connect(services[name])

    def state(self, name: str) -> str:
        """Return the state of a node as it was reported last; empty where it was not."""
        return self._states.get(name, "")

    def turn(self) -> bool:
        """Take up the answers and ask anew; return whether a state is another."""
        before = dict(self._states)
        for name, client in self._clients.items():
            state = client.answer()
            if state:
                self._states[name] = state
            client.ask()
        return self._states != before


class StateClient:
    """A client of rclpy that does not need to be spun."""

    def __init__(self, node: Any, service: str) -> None:
        from lifecycle_msgs.srv import GetState

        self._node = node
        self._type = GetState
        self._client = node.create_client(GetState, service)

    def ask(self) -> None:
        """Send a request, if the service is available."""
        if self._client.service_is_ready():
            with self._client.handle:
                self._client.handle.send_request(self._type.Request())

    def answer(self) -> str:
        """Return the newest answer that came; empty without."""
        state = ""
        with self._client.handle:
            while True:
                header, response = self._client.handle.take_response(self._type.Response)
                if header is None:
                    return state
                state = response.current_state.label

    def close(self) -> None:
        """Let go of the client."""
        self._node.destroy_client(self._client)
