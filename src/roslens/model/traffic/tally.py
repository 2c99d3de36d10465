"""What was counted of one connection in one stretch of time; the record that every way of observing yields."""

from __future__ import annotations

from enum import Enum

import msgspec


class Observer(str, Enum):
    """How something was observed, which determines what a value does not include.

    - inside: counted in the process that publishes or takes
    - protocol: read from what the middleware tells of itself
    - tap: from a subscription of roslens, whose own losses look like those of the application
    - recording: from a bag, which saw what its recorder received
    - agent: sampled from the operating system
    - scripted: made by a test or a demonstration
    """

    INSIDE = "inside"
    PROTOCOL = "protocol"
    TAP = "tap"
    RECORDING = "recording"
    AGENT = "agent"
    SCRIPTED = "scripted"


class Moments(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """Count, sum, sum of squares, least and greatest of a series; two of them merge into that of both.

    With a ``count`` of 0 the other fields mean nothing.
    """

    count: int = 0
    total: float = 0.0
    squares: float = 0.0
    least: float = 0.0
    greatest: float = 0.0

    def merged(self, other: Moments) -> Moments:
        """Return the moments of both series together."""
        if not self.count:
            return other
        if not other.count:
            return self
        return Moments(
            self.count + other.count,
            self.total + other.total,
            self.squares + other.squares,
            min(self.least, other.least),
            max(self.greatest, other.greatest),
        )

    @property
    def mean(self) -> float | None:
        """The mean; None of nothing."""
        return self.total / self.count if self.count else None

    @property
    def deviation(self) -> float | None:
        """The standard deviation of the population; None of nothing."""
        if not self.count:
            return None
        mean = self.total / self.count
        return float(max(self.squares / self.count - mean * mean, 0.0) ** 0.5)


NOTHING = Moments()

BY_GID = "gid:"
"""Begins the publisher of a tally whose observer knows its identifier alone, in hexadecimal: ``gid:010f…``. No name of
ROS has a colon. Such a tally goes no further than to where the graph is known, which has the name."""


class Tally(msgspec.Struct, frozen=True, array_like=True, gc=False):
    """The traffic of a connection between two instants.

    Instants are seconds on the observer's clock, which for a recording is the time of receipt in it.

    Attributes:
        topic: its resolved name.
        publisher: resolved name of the publishing node, or its identifier behind ``BY_GID``; empty where the observer
            cannot tell.
        subscriber: resolved name of the receiving node; empty for traffic seen at the publisher, or in a recording.
        start: beginning of the stretch.
        end: its end.
        count: messages.
        bytes: their serialised size in total; -1 where the observer cannot see it.
        first: when the first message came, 0 without messages.
        last: when the last came, 0 without messages.
        period: moments of the times between messages in seconds; the gap from the last message of the stretch before
            belongs to the stretch in which it ended.
        latency: moments of the times from publishing to receipt in seconds.
        age: moments of the times from the stamp in the header to receipt in seconds.
        lost: messages known to be lost; -1 where the observer cannot tell.
        observer: how it was observed.
        host: on which the observer stands; empty where that is unknown.
        processing: moments of the times from receipt to the message that answers it, in seconds.
        longest_at: when the longest of the times between messages began; 0 where unknown.
    """

    topic: str
    publisher: str
    subscriber: str
    start: float
    end: float
    count: int = 0
    bytes: int = -1
    first: float = 0.0
    last: float = 0.0
    period: Moments = NOTHING
    latency: Moments = NOTHING
    age: Moments = NOTHING
    lost: int = -1
    observer: Observer = Observer.SCRIPTED
    host: str = ""
    processing: Moments = NOTHING
    longest_at: float = 0.0
