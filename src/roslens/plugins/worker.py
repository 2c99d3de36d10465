"""The process in which plug-ins run.

It keeps the two pipes to its parent for itself: what plug-ins print, and what the programs they start
print, goes to the file that the parent named. When the parent is gone, so is this process with all its
children, whatever a plug-in is doing.
"""

from __future__ import annotations

import faulthandler
import os
import signal
import sys
import threading
from queue import SimpleQueue
from typing import BinaryIO

from roslens.plugins.frames import LOST_CONNECTION, ORDER_DECODER, Answer, frame, read_frame
from roslens.plugins.perform import Performer


def main() -> None:
    """Serve orders from standard input until it is closed."""
    orders, answers = _private_pipes()
    faulthandler.enable()
    # A plug-in may stand in the workspace, and import or start its other files whenever it likes.
    sys.dont_write_bytecode = True
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    queue: SimpleQueue[bytes] = SimpleQueue()
    threading.Thread(target=_receive, args=(orders, queue), daemon=True).start()
    performer = Performer(lambda answer: _send(answers, answer))
    while True:
        performer.perform(ORDER_DECODER.decode(queue.get()))


def _private_pipes() -> tuple[BinaryIO, int]:
    """Move the pipes out of reach of plug-ins: standard input is empty, standard output is standard error."""
    orders = os.fdopen(os.dup(0), "rb")
    answers = os.dup(1)
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    sys.stdin = open(0, encoding="utf-8", closefd=False)  # noqa: SIM115 - lives as long as the process
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(encoding="utf-8", errors="backslashreplace", line_buffering=True)  # type: ignore[union-attr]
    return orders, answers


def _receive(orders: BinaryIO, queue: SimpleQueue[bytes]) -> None:
    while (body := read_frame(orders)) is not None:
        queue.put(body)
    os.killpg(0, signal.SIGKILL)


def _send(answers: int, answer: Answer) -> None:
    for stream in (sys.stdout, sys.stderr):
        if stream is not None and not stream.closed:
            stream.flush()
    rest = memoryview(frame(answer))
    try:
        while rest:
            rest = rest[os.write(answers, rest) :]
    except OSError:
        os._exit(LOST_CONNECTION)


if __name__ == "__main__":
    main()
