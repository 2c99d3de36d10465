"""Own subscriptions, only where asked for: emptied every 40 ms without an executor, within a share of a core.

A tap receives messages of its own: what it loses the application may have got, and what it costs the publisher the
publisher would not have spent without it.
"""

from __future__ import annotations

import importlib
import re
import time
from collections.abc import Callable, Iterator
from typing import Any

import msgspec

from roslens.live.adapters.ros2 import TOOL
from roslens.live.inside import slots
from roslens.live.inside.counters import Counted, joined
from roslens.live.inside.sequence import Sequence
from roslens.live.inside.snapshot import Snapshot, difference, snapshot
from roslens.model.failure import Failure
from roslens.model.graph import Endpoint, Graph, Role
from roslens.model.traffic.tally import Observer, Tally

DRAIN_S = 0.04
"""Who wakes up for more messages at a time pays less for each; the middleware keeps so many of 25,000 a second."""
DEPTH = 1000
TURN_S = 1.0
"""How long a topic is observed at least: what is subscribed to for less is hardly found."""


def within(costs: dict[str, float], credit: float, first: int) -> list[str]:
    """Choose the topics to observe next, in turn from number ``first`` on.

    Args:
        costs: CPU seconds that each takes in a period, 0 where unknown.
        credit: CPU seconds that may be spent; negative after a period that took more than it had.
        first: number of the topic that is first in turn.

    Returns:
        As many as fit; one that alone takes more than there is comes when the credit is no longer negative.
    """
    names = sorted(costs)
    turn = names[first % len(names) :] + names[: first % len(names)] if names else []
    chosen: list[str] = []
    for name in turn:
        if credit < 0 or (chosen and costs[name] > credit):
            break
        chosen.append(name)
        credit -= costs[name]
    return chosen


def matcher(pattern: str) -> Callable[[str], bool]:
    """Return what matches a topic: ``*`` is within one part of a name, ``**`` any number of them."""
    parts = re.split(r"(\*\*|\*|\?)", pattern)
    wild = {"**": ".*", "*": "[^/]*", "?": "[^/]"}
    expression = re.compile("".join(wild.get(part, re.escape(part)) for part in parts))
    return lambda name: expression.fullmatch(name) is not None


class _Open:
    """One subscription of the tap, and what came by it, by publisher."""

    def __init__(self, subscription: Any, topic: str) -> None:
        self.subscription = subscription
        self.topic = topic
        self.count = 0
        self._slots: dict[bytes, tuple[slots.Slot, Sequence, memoryview]] = {}
        self._before: dict[bytes, Snapshot] = {}
        self._lost: dict[bytes, int] = {}

    def drain(self) -> None:
        """Take all that is there."""
        take, kind = self.subscription.handle.take_message, self.subscription.msg_type
        count, now = 0, time.time_ns()
        last: Any = None
        while (taken := take(kind, True)) is not None:
            message, info = taken
            count += 1
            gid = info["publisher_gid"]["data"] if "publisher_gid" in info else b""
            if gid != last:
                last = gid
                arrived, sequence = self._of(bytes(gid))
            number = info.get("publication_sequence_number")
            if number is not None:
                if number == sequence.following:
                    sequence.following = number + 1
                else:
                    sequence.feed(number, now)
            received, sent = info["received_timestamp"] or now, info["source_timestamp"]
            arrived(now, received, received - sent if sent else None, None, len(message), sequence)
        self.count += count

    def _of(self, gid: bytes) -> tuple[Callable[..., None], Sequence]:
        """Return what counts the messages of a publisher, and what knows which of them are lost."""
        if gid not in self._slots:
            words = memoryview(bytearray(slots.SLOT_BYTES))
            # One subscription takes what a publisher sends in order. So a loss belongs to the gap that it leaves.
            self._slots[gid] = (slots.Slot(words), Sequence(in_order=True), words)
            self._slots[gid][0].begin(slots.TAKEN, gid, self.topic, "", "")
        slot, sequence, _ = self._slots[gid]
        return slot.arrived, sequence

    def tallies(self, start: float, end: float) -> Iterator[tuple[str, Tally]]:
        """Yield publisher and tally since the last call."""
        for gid, (_, _, words) in self._slots.items():
            now = snapshot(words)
            if now is None:
                continue
            tally = difference(self._before.get(gid), now, start, end, self._lost.get(gid, 0))
            self._before[gid] = now
            self._lost[gid] = self._lost.get(gid, 0) + max(0, tally.lost)
            yield gid[:16].hex(), tally


class Tap:
    """Subscribes to topics that match, as many at a time as the budget allows, and in turn.

    Args:
        node: of rclpy.
        patterns: of names of topics.
        percent: of a core that may be spent.
        host: the name of this host.

    Attributes:
        active: whether there is something to drain.
    """

    def __init__(self, node: Any, patterns: list[str], percent: float, host: str = "") -> None:
        self._node = node
        self._host = host
        self._matchers = [matcher(pattern) for pattern in patterns]
        self._share = percent / 100
        self._ends: dict[str, list[Endpoint]] = {}
        self._costs: dict[str, float] = {}
        self._open: dict[str, _Open] = {}
        self._refused: set[tuple[str, str]] = set()
        self._failures: list[Failure] = []
        self._turn = 0
        self._debt = 0.0
        self._shed = 0
        self._since = self._settled = time.time()
        self._spent = time.process_time()

    @property
    def active(self) -> bool:
        """Whether there is something to drain."""
        return bool(self._open)

    def choose(self, graph: Graph) -> None:
        """Take note of the topics that are there."""
        ends: dict[str, list[Endpoint]] = {}
        for end in graph.endpoints:
            if end.role is Role.PUBLISHER and any(matches(end.name) for matches in self._matchers):
                ends.setdefault(end.name, []).append(end)
        self._ends = ends
        self._costs = {name: self._costs.get(name, 0.0) for name in ends}
        for name in self._open.keys() - ends.keys():
            self._close(name)
        if not self._debt:
            for name in within(self._costs, self._share, self._turn):
                self._subscribe(name)

    def drain(self) -> None:
        """Take all that came."""
        for one in self._open.values():
            one.drain()

    def tallies(self, now: float, node_of: Callable[[str], str | None]) -> list[Tally]:
        """Return what came since the last call; once in a turn choose anew what to observe in the next."""
        self.drain()
        counted = [
            Counted(0, gid, tally, "") for one in self._open.values() for gid, tally in one.tallies(self._since, now)
        ]
        # A node that came back has a dead publisher beside the living one, for as long as the middleware waits for it.
        found = [
            msgspec.structs.replace(tally, observer=Observer.TAP) for tally in joined(counted, node_of, self._host)
        ]
        if now - self._settled >= TURN_S:
            self._rotate(self._settle_account(now - self._settled))
            self._settled = now
        self._since = now
        return found

    def failures(self) -> list[Failure]:
        """Return what went wrong since this was last asked."""
        failures, self._failures = self._failures, []
        return failures

    def shed(self) -> int:
        """Return how many topics were left out since this was last asked, for the sake of the budget."""
        shed, self._shed = self._shed, 0
        return shed

    def _settle_account(self, seconds: float) -> float:
        """Charge what the whole process spent, a topic by its share of the messages; return what may be spent next."""
        spent, self._spent = time.process_time() - self._spent, time.process_time()
        allowed = self._share * max(seconds, 0.0)
        self._debt = max(0.0, self._debt + spent - allowed)
        messages = sum(one.count for one in self._open.values())
        for name, one in self._open.items():
            self._costs[name] = spent * one.count / messages if messages else 0.0
            one.count = 0
        return -self._debt if self._debt else allowed

    def _rotate(self, credit: float) -> None:
        chosen = within(self._costs, credit, self._turn)
        left_out = len(self._costs) - len(chosen)
        self._shed += left_out
        if left_out:
            self._turn += max(1, len(chosen))
        for name in self._open.keys() - set(chosen):
            self._close(name)
        for name in chosen:
            self._subscribe(name)

    def _subscribe(self, name: str) -> None:
        if name in self._open:
            return
        end = self._ends[name][0]
        if (name, end.type) in self._refused:
            return
        from rclpy.qos import QoSProfile, QoSReliabilityPolicy

        reliable = all(one.qos is not None and one.qos.reliability == "reliable" for one in self._ends[name])
        policy = QoSReliabilityPolicy.RELIABLE if reliable else QoSReliabilityPolicy.BEST_EFFORT
        try:
            package, _, kind = end.type.partition("/msg/")
            message = getattr(importlib.import_module(f"{package}.msg"), kind)
            subscription = self._node.create_subscription(
                message, name, _nothing, QoSProfile(depth=DEPTH, reliability=policy), raw=True
            )
        except Exception as error:  # noqa: BLE001 - what a type's support raises is anything
            self._refused.add((name, end.type))
            self._failures.append(
                Failure(
                    TOOL,
                    f"{name} cannot be tapped: {type(error).__name__}: {error}",
                    f"the messages of {end.type} in the Python of the observer",
                    "Source the workspace that has them before roslens starts",
                    entity=f"topic:{name}",
                )
            )  # fmt: skip
            return
        self._open[name] = _Open(subscription, name)

    def _close(self, name: str) -> None:
        self._node.destroy_subscription(self._open.pop(name).subscription)


def _nothing(_: object) -> None:
    """Never called: the node is not spun."""
