"""Notice of processes that end, from the kernel and at once: the middleware needs 20 s to miss one that crashed."""

from __future__ import annotations

import os
import select
import threading
from collections.abc import Callable

from roslens.children.exit_status import how_it_ended
from roslens.model.acting.process_end import UNKNOWN


class ProcessEnds:
    """Watches processes of this host.

    Args:
        ended: called with the id of a process that ended and how it did (`model/acting/process_end.py`), in a
            thread of its own.
    """

    def __init__(self, ended: Callable[[int, str], None]) -> None:
        self._ended = ended
        self._poll = select.epoll()
        self._pids: dict[int, int] = {}
        self._lock = threading.Lock()
        self._reader, self._writer = os.pipe()
        self._poll.register(self._reader, select.EPOLLIN)
        self._thread = threading.Thread(target=self._watch, daemon=True, name="process ends")
        self._thread.start()

    def watch(self, pid: int) -> None:
        """Watch a process; one that has ended already is reported too."""
        with self._lock:
            if pid in self._pids.values():
                return
            try:
                descriptor = os.pidfd_open(pid)
            except ProcessLookupError:
                self._ended(pid, UNKNOWN)
                return
            except OSError:
                return
            self._pids[descriptor] = pid
            self._poll.register(descriptor, select.EPOLLIN)

    def _watch(self) -> None:
        while True:
            for descriptor, _ in self._poll.poll():
                if descriptor == self._reader:
                    return
                with self._lock:
                    pid = self._pids.pop(descriptor)
                    self._poll.unregister(descriptor)
                how = how_it_ended(pid, descriptor)
                os.close(descriptor)
                self._ended(pid, how)

    def close(self) -> None:
        """Stop watching."""
        os.write(self._writer, b".")
        self._thread.join()
        for descriptor in (*self._pids, self._reader, self._writer):
            os.close(descriptor)
        self._poll.close()
