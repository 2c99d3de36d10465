"""The observer's end of the line: what the monitor asks it to publish, read by a thread of its own."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable

from roslens.model.acting.outgoing import Outgoing, OutgoingError, OutgoingReader

_PIECE = 1 << 16


def when_asked(
    descriptor: int, publish: Callable[[Outgoing], None], complain: Callable[[str], None]
) -> threading.Thread:
    """Call ``publish`` with every frame that comes, until the line is closed.

    Args:
        descriptor: to read from.
        publish: called in the thread that is returned; what it raises is reported and ends nothing.
        complain: called with what could not be read or published, each text once in a row.
    """
    thread = threading.Thread(target=_read, args=(descriptor, publish, complain), name="asked", daemon=True)
    thread.start()
    return thread


def _read(descriptor: int, publish: Callable[[Outgoing], None], complain: Callable[[str], None]) -> None:
    reader = OutgoingReader()
    said = ""
    while piece := _piece(descriptor):
        try:
            for frame in reader.feed(piece):
                problem = _published(frame, publish)
                if problem and problem != said:
                    complain(problem)
                said = problem
        except OutgoingError as error:
            complain(f"nothing is published any more: {error}")
            return


def _published(frame: Outgoing, publish: Callable[[Outgoing], None]) -> str:
    try:
        publish(frame)
    except Exception as error:  # noqa: BLE001 - the classes of rclpy's errors differ by version; observing goes on
        return f"cannot be published: {type(error).__name__}: {error}"
    return ""


def _piece(descriptor: int) -> bytes:
    try:
        return os.read(descriptor, _PIECE)
    except OSError:
        return b""
