"""Which messages of a publisher are lost, by the numbers it gives them."""

from __future__ import annotations

from collections import deque

SETTLE_NS = 150_000_000
"""How long a message may be late before it counts as lost. A reliable connection that sends again hands messages over
in order, so whoever takes them sees no gap; what comes late of others was overtaken on its way or between threads."""
MOST_GAPS = 256


class Sequence:
    """Follows the numbers of one publisher at one subscription.

    The first number seen is the beginning: who comes late has lost nothing. A publisher that is started again has
    another identifier, hence another sequence. Numbers that come late, within the delay, fill their gap.

    Args:
        in_order: whether the numbers only ever grow, so that what is missing is lost at once.

    Attributes:
        following: the number that comes next if none is missing; a message that bears it may be counted by raising
            this by one, and losses settle with the next that does not, or for a reader by the time of the newest gap.
        lost: messages known to be lost.
        pending: messages missing for less than the delay.
        pending_since: ns at which the newest gap was seen.
        touched: whether one of these changed since somebody set it to False.
    """

    __slots__ = ("_gaps", "_in_order", "following", "lost", "pending", "pending_since", "touched")

    def __init__(self, *, in_order: bool = False) -> None:
        self.following: int | None = None
        self._in_order = in_order
        self._gaps: deque[tuple[int, int, int]] = deque()
        self.lost = 0
        self.pending = 0
        self.pending_since = 0
        self.touched = True

    def feed(self, number: int, now: int) -> None:
        """Take the number of a message that came at ``now`` (ns)."""
        expected = self.following
        if self._gaps:
            self.settle(now)
        if number == expected or expected is None:
            self.following = number + 1
        elif number > expected:
            self.touched = True
            self._gaps.append((now, expected, number - 1))
            self.pending += number - expected
            self.pending_since = now
            self.following = number + 1
            if self._in_order or len(self._gaps) > MOST_GAPS:
                self._lose()
        else:
            self._fill(number)

    def settle(self, now: int) -> None:
        """Count as lost what is missing for longer than the delay."""
        while self._gaps and now - self._gaps[0][0] > SETTLE_NS:
            self._lose()

    def _lose(self) -> None:
        self.touched = True
        _, first, last = self._gaps.popleft()
        self.lost += last - first + 1
        self.pending -= last - first + 1

    def _fill(self, number: int) -> None:
        for at, (seen, first, last) in enumerate(self._gaps):
            if first <= number <= last:
                del self._gaps[at]
                # In front of each other, in the place of the gap they come from: the order of times holds.
                if number < last:
                    self._gaps.insert(at, (seen, number + 1, last))
                if first < number:
                    self._gaps.insert(at, (seen, first, number - 1))
                self.touched = True
                self.pending -= 1
                return
