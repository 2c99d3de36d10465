"""The process in which plug-ins run.

It keeps the two pipes to its parent for itself: what plug-ins print, and what the programs they start
print, goes to the file that the parent named. When the parent is gone, so is this process with all its
children, whatever a plug-in is doing.
"""

from __future__ import annotations

import contextlib
import faulthandler
import os
import select
import signal
import sys
import threading
from queue import SimpleQueue
from typing import BinaryIO

import msgspec

from roslens.children.limits import limit_process
from roslens.children.sandbox import SCRATCH_VARIABLES, confine, sandbox_of_text
from roslens.plugins.frames import LOST_CONNECTION, ORDER_DECODER, Answer, Gave, frame, read_frame
from roslens.plugins.perform import Performer


def main(sandbox: str = "") -> None:
    """Serve orders from standard input until it is closed.

    Args:
        sandbox: what plug-ins may touch; empty for all that the user may.
    """
    limit_process()
    _guard_group()
    if sandbox:
        _confine(sandbox)
    orders, answers = _private_pipes()
    own = os.getpid()
    faulthandler.enable()
    # A plug-in may stand in the workspace, and import or start its other files whenever it likes.
    sys.dont_write_bytecode = True
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    queue: SimpleQueue[bytes] = SimpleQueue()
    threading.Thread(target=_receive, args=(orders, queue), daemon=True).start()
    performer = Performer(lambda answer: _send(answers, own, answer))
    while True:
        performer.perform(ORDER_DECODER.decode(queue.get()))


def _confine(text: str) -> None:
    """Give up everything else. It holds for threads that are started later, so none may run before.

    Raises:
        OSError: the kernel refuses.
    """
    sandbox = sandbox_of_text(text)
    confine(sandbox)
    os.environ.update(dict.fromkeys(SCRATCH_VARIABLES, sandbox.write[0]))


def _guard_group() -> None:
    """Have a process apart end this one and all that it starts once nobody can give orders any more.

    The kernel ends this one with its parent, at times before its own thread sees the pipe closed; and a hook may hold
    the interpreter for ever. What it started would go on.
    """
    group = os.getpgrp()
    if os.fork():
        return
    os.setsid()
    nothing = os.open(os.devnull, os.O_RDWR)
    for stream in (1, 2):
        os.dup2(nothing, stream)
    hung_up = select.poll()
    hung_up.register(0, 0)
    hung_up.poll()
    with contextlib.suppress(OSError):
        os.killpg(group, signal.SIGKILL)
    os._exit(0)


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


def _send(answers: int, own: int, answer: Answer) -> None:
    if os.getpid() != own:
        # A hook that forked came back twice; what this copy says would be said a second time.
        os._exit(0)
    for stream in (sys.stdout, sys.stderr):
        if stream is not None and not stream.closed:
            stream.flush()
    if isinstance(answer, Gave):
        with contextlib.suppress(OSError):
            answer = msgspec.structs.replace(answer, printed=os.fstat(2).st_size)
    rest = memoryview(frame(answer))
    try:
        while rest:
            rest = rest[os.write(answers, rest) :]
    except OSError:
        os._exit(LOST_CONNECTION)


if __name__ == "__main__":
    main()
