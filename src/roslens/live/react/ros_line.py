"""The monitor's side of a process that acts in ROS: started, given orders, and started again when it ends."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from roslens.children.safe_path import NEUTRAL
from roslens.live.adapters.child import clean_environment
from roslens.live.publish.downlink import Downlink
from roslens.model.acting.order import VERSION, Order, OrderError, OrderReader, Reply, Verb, encode_order

_PAUSE_S = 1.0
_STOP_S = 3.0
_PIECE = 65_536
_MOST_SAID = 2_000


class RosLine:
    """A process that takes orders. Nothing here waits.

    After an unplanned end it is started again, and everything that was prepared is prepared again; what was under
    way is answered as not done.

    Attributes:
        generation: of ROS.
        said: what it wrote last on standard error.
    """

    def __init__(
        self, generation: int, command: Sequence[str], environment: Mapping[str, str], steady: Callable[[], float]
    ) -> None:
        """Start ``command``; ``steady`` is a clock that never jumps."""
        self.generation = generation
        self.said = ""
        self._command = list(command)
        self._environment = clean_environment(environment)
        self._steady = steady
        self._downlink = Downlink()
        self._process: subprocess.Popen[bytes] | None = None
        self._reader: OrderReader[Reply] = OrderReader(Reply)
        self._prepared: dict[str, Order] = {}
        self._under_way: dict[str, Order] = {}
        self._due = float("-inf")
        self._start()

    def fileno(self) -> int | None:
        """Return the descriptor that becomes readable with the next reply."""
        return self._process.stdout.fileno() if self._process and self._process.stdout else None

    def prepare(self, id_: str, kind: str, target: str, arguments: Mapping[str, Any]) -> None:
        """Have it prepare an action; a reply reports whether it can."""
        order = Order(VERSION, id_, Verb.PREPARE, kind, target, dict(arguments))
        self._prepared[id_] = order
        self._say(order)

    def forget(self, id_: str) -> None:
        """Prepare something no more when the process is started again."""
        self._prepared.pop(id_, None)

    def do(self, id_: str, kind: str, target: str, arguments: Mapping[str, Any]) -> None:
        """Have it carried out; a reply reports the result.

        Raises:
            OrderError: it cannot be sent.
        """
        order = Order(VERSION, id_, Verb.DO, kind, target, dict(arguments))
        body = encode_order(order)
        self._under_way[id_] = order
        self._downlink.say(body)

    def clear(self, id_: str) -> None:
        """Report that the cause of an action is gone."""
        self._say(Order(VERSION, id_, Verb.CLEAR))

    def stop(self) -> None:
        """End whatever repeats."""
        self._say(Order(VERSION, "", Verb.STOP))

    def poll(self) -> list[Reply]:
        """Return the replies that came."""
        if self._process is None:
            if self._steady() >= self._due:
                self._start()
            return []
        code = self._process.poll()
        found = self._replies()
        self._listen()
        if code is not None:
            found += self._ended(f"the process that acts in ROS {self.generation} ended with {code}")
        return found

    def close(self) -> None:
        """End the process."""
        if self._process is None:
            return
        self._downlink.detach()
        self._process.terminate()
        try:
            self._process.wait(_STOP_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._release()

    def _start(self) -> None:
        self._reader = OrderReader(Reply)
        try:
            self._process = subprocess.Popen(
                self._command, env=self._environment, cwd=NEUTRAL, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                stderr=subprocess.PIPE, bufsize=0,
            )  # fmt: skip
        except OSError as error:
            self.said = f"{self._command[0]}: {error.strerror or error}"
            self._due = self._steady() + _PAUSE_S
            return
        for stream in (self._process.stdout, self._process.stderr):
            if stream is not None:
                os.set_blocking(stream.fileno(), False)
        if self._process.stdin is not None:
            self._downlink.attach(self._process.stdin)
        for order in self._prepared.values():
            self._say(order)

    def _say(self, order: Order) -> None:
        self._downlink.say(encode_order(order))

    def _replies(self) -> list[Reply]:
        found: list[Reply] = []
        if self._process is None or self._process.stdout is None:
            return found
        try:
            while piece := _read(self._process.stdout.fileno()):
                found.extend(self._reader.feed(piece))
        except OrderError as error:
            self.said = str(error)
            self._process.kill()
        for reply in found:
            if reply.verb is Verb.DO:
                self._under_way.pop(reply.id, None)
        return found

    def _listen(self) -> None:
        if self._process is not None and self._process.stderr is not None:
            while piece := _read(self._process.stderr.fileno()):
                self.said = (self.said + piece.decode("utf-8", "replace"))[-_MOST_SAID:]

    def _ended(self, why: str) -> list[Reply]:
        self._release()
        self._due = self._steady() + _PAUSE_S
        last = self.said.strip().rpartition("\n")[2][:300]
        text = f"{why}: {last}" if last else why
        lost = [Reply(VERSION, one.id, one.verb, False, text) for one in self._under_way.values()]
        self._under_way.clear()
        return lost

    def _release(self) -> None:
        self._downlink.detach()
        if self._process is not None:
            for stream in (self._process.stdout, self._process.stderr):
                if stream is not None:
                    stream.close()
        self._process = None


def _read(descriptor: int) -> bytes:
    try:
        return os.read(descriptor, _PIECE)
    except BlockingIOError:
        return b""
