"""The types that publishers themselves give, where the one that the master keeps for a topic may not be theirs."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from concurrent.futures import Executor, Future

from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.slave import Slave
from roslens.live.adapters.ros1.wire.tcpros import TcprosError, connect
from roslens.live.adapters.ros1.wire.xml_rpc import CallError


def asked_type(uri: str, topic: str, caller: str, resolver: Resolver, wait_s: float) -> str:
    """Return the type of what a node publishes on a topic, by a handshake with it; empty where it does not tell."""
    slave = Slave(uri, caller, resolver, wait_s)
    try:
        host, port = slave.request(topic)
        line, handshake = connect(resolver.address(host), port, topic, caller, wait_s)
        line.close()
    except (CallError, TcprosError, OSError):
        return ""
    finally:
        slave.close()
    return handshake.type


class PublisherTypes:
    """Asks each publisher once, in threads of a pool.

    Args:
        ask: returns the type that the node with an API publishes on a topic.
        pool: of the threads.
    """

    def __init__(self, ask: Callable[[str, str], str], pool: Executor) -> None:
        self._ask = ask
        self._pool = pool
        self._asked: dict[tuple[str, str], tuple[str, Future[str]]] = {}

    def want(self, publishers: Iterable[tuple[str, str, str]]) -> None:
        """Ask publishers, each a topic, a node and the URI of its API; others are forgotten."""
        asked = {}
        for topic, node, uri in publishers:
            known = self._asked.get((topic, node))
            if known is None or known[0] != uri:
                known = uri, self._pool.submit(self._ask, uri, topic)
            asked[topic, node] = known
        self._asked = asked

    def of(self, topic: str, node: str) -> str:
        """Return the type that a node said it publishes on a topic; empty while that is not known."""
        _, answer = self._asked.get((topic, node), ("", None))
        return answer.result() if answer is not None and answer.done() else ""
