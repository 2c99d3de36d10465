"""Keeps what was said in the last seconds, in memory and bounded, and writes it with what is said next."""

from __future__ import annotations

import os
import threading
import time
from collections import deque
from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import msgspec

from roslens.live.act.mcap_writer import McapWriter
from roslens.live.act.ros import ActionError

MOST_BYTES = 64_000_000
"""Of all that is kept of one action; of more, the oldest is given up."""

_MOST_FILE_BYTES = 1_000_000_000


class Topic(msgspec.Struct, frozen=True):
    """What a recording has to know of a topic.

    Attributes:
        name: of the topic.
        type: of its messages.
        language: of the definition: ``ros1msg`` or ``ros2msg``.
        definition: with all that it holds; empty where nobody knows.
        encoding: ``ros1`` or ``cdr``.
        more: what else is reported of the channel.
    """

    name: str
    type: str
    language: str
    definition: str
    encoding: str
    more: tuple[tuple[str, str], ...] = ()


class _Kept(msgspec.Struct, frozen=True):
    topic: Topic
    time: float
    body: bytes


class Keeping:
    """The last ``before_s`` seconds of some topics; for many threads. Times are seconds since the epoch."""

    def __init__(self, before_s: float, wall: Callable[[], float] = time.time, most_bytes: int = MOST_BYTES) -> None:
        """Keep nothing yet."""
        self._before_s = before_s
        self._wall = wall
        self._most = most_bytes
        self._kept: deque[_Kept] = deque()
        self._bytes = 0
        self._lock = threading.Lock()
        self._writing: list[_Writing] = []

    def received(self, topic: Topic, body: bytes) -> None:
        """Take a message."""
        one = _Kept(topic, self._wall(), body)
        with self._lock:
            self._kept.append(one)
            self._bytes += len(body)
            while self._kept and (self._bytes > self._most or self._kept[0].time < one.time - self._before_s):
                self._bytes -= len(self._kept.popleft().body)
            for writing in self._writing:
                writing.put(one)

    def write(self, path: str, profile: str, after_s: float, waited: Callable[[float], object] = time.sleep) -> str:
        """Write what is kept, and what is received in the next ``after_s``; return what was written.

        Raises:
            ActionError: it cannot be written.
        """
        place = Path(path)
        try:
            place.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
            file = os.open(place, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(file, "wb") as stream:
                writing = _Writing(stream, profile)
                now = self._wall()
                with self._lock:
                    for one in self._kept:
                        if one.time >= now - self._before_s:
                            writing.put(one)
                    self._writing.append(writing)
                try:
                    waited(after_s)
                finally:
                    with self._lock:
                        self._writing.remove(writing)
                writing.end()
        except OSError as error:
            raise ActionError(f"{place} cannot be written: {error.strerror or error}") from None
        messages = f"{writing.count} message{'' if writing.count == 1 else 's'}"
        topics = f"{writing.topics} topic{'' if writing.topics == 1 else 's'}"
        return f"{messages} of {topics}, {writing.length_s:.1f} s long, in {place}"


class _Writing:
    """One file that is written; an error is kept until the end, so that who speaks is not held up by it."""

    def __init__(self, stream: BinaryIO, profile: str) -> None:
        self._mcap = McapWriter(stream, profile)
        self._channels: dict[Topic, int] = {}
        self._error: OSError | None = None
        self._bytes = 0
        self._first = self._last = 0.0
        self.count = 0

    @property
    def topics(self) -> int:
        """How many topics something was written of."""
        return len(self._channels)

    @property
    def length_s(self) -> float:
        """Seconds from the first message to the last."""
        return self._last - self._first

    def put(self, one: _Kept) -> None:
        """Write a message."""
        if self._error is not None or self._bytes + len(one.body) > _MOST_FILE_BYTES:
            return
        topic = one.topic
        try:
            if topic not in self._channels:
                self._channels[topic] = self._mcap.channel(
                    topic.name, topic.type, topic.language, topic.definition, topic.encoding, dict(topic.more)
                )
            self._mcap.message(self._channels[topic], self.count, round(one.time * 1e9), one.body)
        except OSError as error:
            self._error = error
            return
        self._first = self._first if self.count else one.time
        self._last = one.time
        self._bytes += len(one.body)
        self.count += 1

    def end(self) -> None:
        """Write the end.

        Raises:
            OSError: something could not be written.
        """
        if self._error is not None:
            raise self._error
        self._mcap.end()
