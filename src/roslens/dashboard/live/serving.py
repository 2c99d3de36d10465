"""Serves the live page from a thread of its own, beside who watches."""

from __future__ import annotations

from collections.abc import Callable
from threading import Event, Thread

import uvicorn

from roslens.dashboard.access.policy import Access
from roslens.dashboard.listener import Tls, address_shown, listen
from roslens.dashboard.live.app import Facts, create_live_app, no_graph, nothing
from roslens.dashboard.live.board import Board
from roslens.dashboard.live.further import Further
from roslens.dashboard.live.past import Past
from roslens.dashboard.live.sight import Sight
from roslens.dashboard.live.snapshot import Snapshot
from roslens.dashboard.patient_protocol import PatientProtocol

_ADVICE = "Give --serve another port, or 0 for any free one"
_GRACE_S = 2


class LivePage:
    """The page of one watch; a context manager that ends with it."""

    def __init__(
        self, snapshot: Callable[[], bytes], *, detail: Callable[[str], bytes] = nothing,
        graph: Callable[[], bytes] = no_graph, past: Past | None = None, board: Board | None = None,
        state: Callable[[], Snapshot | None] | None = None, sight: Sight | None = None,
        host: str = "127.0.0.1", port: int = 0, access: Access | None = None, tls: Tls | None = None,
        further: Further | None = None, why: Callable[[str], bytes] = nothing,
    ) -> None:  # fmt: skip
        """Serve what these return; all are called from the server's threads.

        Args:
            snapshot: returns the newest snapshot.
            detail: returns all that is known of an entity.
            graph: returns the computation graph.
            past: of what is shown; None where nothing is kept.
            board: references and notes on alerts.
            state: returns what `snapshot` returns before it is JSON.
            sight: is given what readers see.
            host: name or address to listen on.
            port: to listen on; 0 takes a free one.
            access: who may view and who may act; by default anyone may view and no one may act.
            tls: certificate and key to encrypt with.
            further: pages beside this one.
            why: returns why an entity is as it is now.

        Raises:
            UsageError: the host is unknown, or the port is taken or not allowed.
        """
        local = "Give --serve a port alone to serve on this machine only"
        self._listener = listen(host, port, local=local, free=_ADVICE)
        self.url = address_shown(self._listener, encrypted=tls is not None)
        self._stopping = Event()
        facts = Facts(frozenset({host.lower()}), access=access, further=further or Further())
        self._server = uvicorn.Server(
            uvicorn.Config(
                create_live_app(
                    snapshot,
                    facts,
                    detail=detail,
                    graph=graph,
                    past=past,
                    board=board,
                    state=state,
                    sight=sight,
                    stopped=self._stopping.is_set,
                    why=why,
                ),
                log_level="error",
                access_log=False,
                lifespan="off",
                server_header=False,
                ws="none",
                http=PatientProtocol,
                timeout_graceful_shutdown=_GRACE_S,
                ssl_certfile=tls.certificate if tls else None,
                ssl_keyfile=tls.key if tls else None,
            )
        )
        self._thread = Thread(target=self._server.run, args=([self._listener],), name="live page", daemon=True)
        self._thread.start()

    def __enter__(self) -> LivePage:
        """Return itself."""
        return self

    def __exit__(self, *_: object) -> None:
        """Serve no more."""
        self.close()

    def close(self) -> None:
        """End the streams and then the server."""
        self._stopping.set()
        self._server.should_exit = True
        self._thread.join(2 * _GRACE_S + 1)
        self._listener.close()
