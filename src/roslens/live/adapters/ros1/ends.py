"""Detection of processes that end: immediate, from kernel events on a process and on a connection to it."""

from __future__ import annotations

import os
import select
import threading
from collections.abc import Callable
from contextlib import suppress


class Ends:
    """Watches processes of this host and connections to any host; reports each end once.

    Args:
        ended: called with the name given with what ended, in a thread of its own.
    """

    def __init__(self, ended: Callable[[str], None]) -> None:
        self._ended = ended
        self._poll = select.epoll()
        self._lock = threading.Lock()
        self._names: dict[int, str] = {}
        self._processes: dict[str, tuple[int, int]] = {}
        self._stop = os.eventfd(0)
        self._open = True
        self._poll.register(self._stop, select.EPOLLIN)
        self._thread = threading.Thread(target=self._watch, daemon=True, name="ends")
        self._thread.start()

    def process(self, name: str, pid: int) -> bool:
        """Watch a process in place of the one watched by this name before; False where that cannot be."""
        with self._lock:
            if self._processes.get(name, (0, 0))[0] == pid:
                return True
            self._drop(name)
            try:
                descriptor = os.pidfd_open(pid)
            except OSError:
                return False
            self._processes[name] = (pid, descriptor)
            self._names[descriptor] = name
            self._poll.register(descriptor, select.EPOLLIN | select.EPOLLONESHOT)
        return True

    def connection(self, name: str, descriptor: int) -> None:
        """Watch an open socket; whoever owns it closes it, which ends the watch."""
        if descriptor < 0:
            return
        with self._lock, suppress(OSError):
            self._names[descriptor] = name
            events = select.EPOLLRDHUP | select.EPOLLONESHOT
            try:
                self._poll.register(descriptor, events)
            except FileExistsError:
                self._poll.modify(descriptor, events)

    def forget(self, name: str) -> None:
        """Watch no process by this name any more."""
        with self._lock:
            self._drop(name)

    def _drop(self, name: str) -> None:
        _, descriptor = self._processes.pop(name, (0, -1))
        if descriptor >= 0:
            self._names.pop(descriptor, None)
            os.close(descriptor)

    def _watch(self) -> None:
        while self._open:
            for descriptor, _ in self._poll.poll():
                with self._lock:
                    name = self._names.get(descriptor)
                if name is not None and self._open:
                    self._ended(name)

    def close(self) -> None:
        """Stop watching."""
        self._open = False
        os.eventfd_write(self._stop, 1)
        self._thread.join()
        with self._lock:
            for name in list(self._processes):
                self._drop(name)
        self._poll.close()
        os.close(self._stop)
