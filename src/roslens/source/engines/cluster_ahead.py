"""A cluster that is connected to while this process still looks for work: its workers get ready meanwhile."""

from __future__ import annotations

import threading
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from functools import partial
from typing import Any

from roslens.source.engines.cluster_readers import make_readers_ready
from roslens.source.engines.dask_engine import fit_client


class ClusterAhead:
    """Connects in a thread of its own; what goes wrong is raised where the connection is wanted."""

    def __init__(self, address: str, folder: str, prepare: Callable[[], None]) -> None:
        """Begin to connect.

        Args:
            address: of the scheduler.
            folder: that workers have to see.
            prepare: is called in each process that reads for a worker.
        """
        self.address = address
        self._found: Future[Any] = Future()
        self._taken = False
        self.thread = threading.Thread(target=self._connect, args=(address, folder, prepare), daemon=True)
        self.thread.start()

    def client(self) -> Any:
        """Return the connection, which is the caller's from now on.

        Raises:
            UsageError: the cluster cannot be reached, or its workers are not fit for the work.
        """
        self._taken = True
        return self._found.result()

    def close(self) -> None:
        """Let go of a connection that nobody wanted, now or as soon as it is there."""
        if not self._taken:
            self._found.add_done_callback(_closed)

    def _connect(self, address: str, folder: str, prepare: Callable[[], None]) -> None:
        try:
            self._found.set_result(fit_client(address, folder, prepare=partial(make_readers_ready, prepare)))
        except BaseException as error:  # noqa: BLE001 - raised where the connection is wanted
            self._found.set_exception(error)


def _closed(found: Future[Any]) -> None:
    with suppress(Exception):
        found.result().close(timeout=5)
