"""Counts messages per topic from the moment each topic has been heard: what both listeners share.

python listen_ros1.py [--ages] SECONDS LIMIT TOPIC...
"""

import argparse
import json
import sys
import threading
import time
from collections.abc import Callable
from typing import Any


class Tally:
    """Counts serialized messages; callbacks may come from any thread.

    Args:
        words: The command line.
        content: The serialized bytes of what a callback gets.
        stamp_at: Where in them a header's time stamp begins: seconds and nanoseconds, four bytes each, little endian.
    """

    def __init__(self, words: list[str], content: Callable[[Any], bytes], stamp_at: int) -> None:
        parser = argparse.ArgumentParser(description="Counts messages.")
        parser.add_argument("--ages", action="store_true", help="tell the time from stamp to receipt; needs headers")
        parser.add_argument("seconds", type=float, help="how long to count")
        parser.add_argument("limit", type=float, help="how long to wait for each topic's first message")
        parser.add_argument("topics", nargs="+")
        self._chosen = parser.parse_args(words)
        self._content = content
        self._stamp_at = stamp_at
        self._all_heard = threading.Event()
        self.topics: list[str] = self._chosen.topics
        self._counts = dict.fromkeys(self.topics, 0)
        self._ages: dict[str, list[float]] = {topic: [] for topic in self.topics}

    def counter(self, topic: str) -> Callable[[Any], None]:
        """A callback for the messages of `topic`."""
        ages = self._ages[topic] if self._chosen.ages else None

        def count(message: Any) -> None:
            now = time.time()
            self._counts[topic] += 1
            if ages is not None:
                stamp = self._content(message)[self._stamp_at : self._stamp_at + 8]
                ages.append(round(now - _number(stamp[:4]) - _number(stamp[4:]) / 1e9, 6))
            if not self._all_heard.is_set() and all(self._counts.values()):
                self._all_heard.set()

        return count

    def report(self) -> int:
        """Waits for all topics, counts, writes the result as JSON; returns the exit code."""
        began = time.monotonic()
        if not self._all_heard.wait(self._chosen.limit):
            silent = [topic for topic, count in self._counts.items() if not count]
            sys.stderr.write(f"nothing heard in {self._chosen.limit} s of {', '.join(silent)}\n")
            return 1
        start, before = time.monotonic(), dict(self._counts)
        time.sleep(self._chosen.seconds)
        passed = time.monotonic() - start
        rates = {topic: round((count - before[topic]) / passed, 3) for topic, count in self._counts.items()}
        found = {"waited": round(start - began, 3), "rates": rates, "ages": self._ages}
        sys.stdout.write(json.dumps(found) + "\n")
        sys.stdout.flush()
        return 0


def _number(four: bytes) -> int:
    return int.from_bytes(four, "little")
