"""What counting in Python costs a message, where the preloaded library is not there to do it.

    python benchmarks/inside_python.py

The hook alone: a taken and a published message through functions shaped like those of rclpy, with and without the hook,
in turn, the least of many short rounds: what another process takes of the machine is in the longer ones. Beside it
stands what that is on a machine that takes 10.5 ns for a turn of an empty loop. At 10 Hz every message opens a bank of
extremes, and latency, period and age are extremes each time: the dearest case. What a node feels is more, since its
caches are cold: ``relay.py``.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from functools import partial
from itertools import count
from types import ModuleType, SimpleNamespace
from typing import Any

from roslens.live.inside import rclpy_hook, slots

ROUNDS = 300
CALLS = 500
QUIET_NS = 10.5
START_NS = 1_700_000_000_000_000_000
SLOW_NS = 100_000_000
GID = bytes(range(16))


class Stamp:
    """A time, kept and reported as generated classes do."""

    __slots__ = ("_nanosec", "_sec")

    def __init__(self) -> None:
        self._sec, self._nanosec = divmod(START_NS, 1_000_000_000)

    @property
    def sec(self) -> int:
        return self._sec

    @property
    def nanosec(self) -> int:
        return self._nanosec


class Header:
    __slots__ = ("_stamp",)

    def __init__(self) -> None:
        self._stamp = Stamp()

    @property
    def stamp(self) -> Stamp:
        return self._stamp


class Stamped:
    """A message with a header."""

    __slots__ = ("_header",)

    def __init__(self) -> None:
        self._header = Header()

    @property
    def header(self) -> Header:
        return self._header

    @staticmethod
    def get_fields_and_field_types() -> dict[str, str]:
        return {"header": "std_msgs/Header"}


class Handle:
    """Gives one message after the other, as fast as it is asked, each of them 50 to 60 us and an odd age old."""

    def __init__(self) -> None:
        self._number = 0
        self._message = Stamped()
        self._stamp = self._message.header.stamp

    def __enter__(self) -> None:
        return None

    def __exit__(self, *_: object) -> None:
        return None

    def get_topic_name(self) -> str:
        return "/topic"

    def get_logger_name(self) -> str:
        return "node"

    def publish(self, _: object) -> None:
        return None

    def take_message(self, _type: object, _raw: bool) -> tuple[Any, dict[str, Any]]:
        self._number = number = self._number + 1
        odd = number * 7919 % 1009 * 10
        when = START_NS + number * 1_000_000 + odd
        self._stamp._sec, self._stamp._nanosec = divmod(when - 1_000_000 - 50 * odd, 1_000_000_000)  # noqa: SLF001
        return self._message, {
            "source_timestamp": when,
            "received_timestamp": when + 50_000 + odd,
            "publication_sequence_number": number,
            "publisher_gid": {"data": GID},
        }


class Subscription:
    raw = False

    def __init__(self, kind: type) -> None:
        self._handle = Handle()
        self.msg_type = kind

    @property
    def handle(self) -> Handle:
        return self._handle


class Node:
    """An executor that takes, and a publisher, of classes of their own."""

    def __init__(self) -> None:
        class Executor:
            def _take_subscription(self, subscription: Any) -> Any:
                with subscription.handle:
                    return subscription.handle.take_message(subscription.msg_type, subscription.raw)

        class Publisher:
            def __init__(self) -> None:
                self._handle = Handle()

            @property
            def handle(self) -> Handle:
                return self._handle

            def publish(self, msg: object) -> None:
                with self.handle:
                    self.handle.publish(msg)

        self.module = ModuleType("rclpy")
        self.module.__dict__.update(Executor=Executor, Publisher=Publisher)
        self._executor, self._publisher = Executor(), Publisher()
        self._plain, self._stamped = Subscription(object), Subscription(Stamped)

    def hook(self) -> None:
        """Count from now on."""
        rclpy_hook.hook_executor(self.module)
        rclpy_hook.hook_publisher(self.module)

    def take(self) -> None:
        """Take messages without a header."""
        take, subscription = self._executor._take_subscription, self._plain  # noqa: SLF001 - it is what is replaced
        for _ in range(CALLS):
            take(subscription)

    def take_stamped(self) -> None:
        """Take messages with a header."""
        take, subscription = self._executor._take_subscription, self._stamped  # noqa: SLF001
        for _ in range(CALLS):
            take(subscription)

    def publish(self) -> None:
        """Publish as a timer does."""
        publish = self._publisher.publish
        rclpy_hook._CURRENT.given = None  # noqa: SLF001
        for _ in range(CALLS):
            publish(None)

    def answer(self) -> None:
        """Publish as a callback does that was given a message."""
        publish = self._publisher.publish
        rclpy_hook._CURRENT.given = ("/topic", time.time_ns() if self._fast else START_NS)  # noqa: SLF001
        for _ in range(CALLS):
            publish(None)

    _fast = True

    def slow(self) -> Node:
        """Go on as at 10 Hz."""
        self._fast = False
        return self


def turns() -> None:
    """Do nothing."""
    for _ in range(CALLS):
        pass


def alone() -> None:
    """Print what the hook adds to a message."""
    bare, node, slow = Node(), Node(), Node().slow()
    kinds = {"taken": Node.take, "taken with a header": Node.take_stamped, "published": Node.publish}
    kinds |= {"published in answer": Node.answer}
    with tempfile.TemporaryDirectory() as folder:
        os.environ[slots.VARIABLE] = folder
        node.hook()
        slow.hook()
        works: dict[tuple[Node | None, str], Callable[[], None]] = {(None, ""): turns}
        works |= {(one, kind): partial(work, one) for one in (bare, node, slow) for kind, work in kinds.items()}
        slowly = SimpleNamespace(time_ns=count(START_NS, SLOW_NS).__next__)
        least = dict.fromkeys(works, float("inf"))
        for _ in range(ROUNDS):
            for key, work in works.items():
                vars(rclpy_hook)["time"] = slowly if key[0] is slow else time
                begun = time.perf_counter()
                work()
                least[key] = min(least[key], (time.perf_counter() - begun) / CALLS * 1e6)
        vars(rclpy_hook)["time"] = time
        rclpy_hook.HOOK.close()
    turn = least[None, ""] * 1e3
    print(f"turn of an empty loop {turn:.1f} ns; in brackets: for one of {QUIET_NS} ns")
    for kind in kinds:
        added = [least[one, kind] - least[bare, kind] for one in (node, slow)]
        fast, dear = (f"+{each:.2f} us ({each / turn * QUIET_NS:.2f})" for each in added)
        print(f"{kind:20} {fast} a message, {dear} at 10 Hz")


if __name__ == "__main__":
    alone()
