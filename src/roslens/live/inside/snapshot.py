"""A slot of a counter file at one instant, and what two of them differ in."""

from __future__ import annotations

import struct
from typing import NamedTuple, SupportsBytes

from roslens.live.inside import slots
from roslens.live.inside.sequence import SETTLE_NS
from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally

_COUNTERS = struct.Struct("=14q" + "qdd" * 4 + "q")
_EXTREMES = struct.Struct("=2d")
_BANK_BYTES = slots.BANK_WORDS * 8
_BANKS = slice(slots.BANKS_AT * 8, (slots.BANKS_AT + slots.BANKS * slots.BANK_WORDS) * 8)
_KIND, _GENERATION = slots.KIND, slots.GENERATION
_COUNTED = slice(slots.COUNT, slots.PERIOD)
_MOMENTS = slice(slots.PERIOD, slots.ENDED)
_PERIOD, _LATENCY, _AGE, _PROCESSING = range(4)
_TRIES = 100
_NO_MOMENTS = (0, 0.0, 0.0) * 4


class Snapshot(NamedTuple):
    """A slot as it was at one instant.

    ``moments`` are count, sum and sum of squares of period, latency, age and processing; ``banks`` are their extremes.
    """

    kind: int
    generation: int
    gid: bytes
    topic: str
    node: str
    other: str
    messages: int
    size: int
    first: int
    last: int
    lost: int
    pending: int
    pending_since: int
    bank: int
    ended: int
    moments: tuple[float, ...]
    banks: bytes


def snapshot(words: memoryview | SupportsBytes, before: Snapshot | None = None) -> Snapshot | None:
    """Copy a slot; None if it is being written whenever it is looked at.

    Two copies must agree, which also holds on processors that reorder what another one writes. Names are taken from
    the copy ``before``, if it is of the same endpoint: to read them costs as much as all the rest.
    """
    earlier = bytes(words)
    for _ in range(_TRIES):
        now = bytes(words)
        if now == earlier and not now[0] & 1 and now[:8] == now[-8:]:
            return _parsed(now, before)
        earlier = now
    return None


def _parsed(raw: bytes, before: Snapshot | None) -> Snapshot:
    values = _COUNTERS.unpack_from(raw)
    kind, generation = values[_KIND], values[_GENERATION]
    if before is not None and before.generation == generation and before.kind == kind:
        gid, topic, node, other = before.gid, before.topic, before.node, before.other
    else:
        gid = raw[slots.GID * 8 : slots.GID * 8 + 24]
        topic, node, other = (text_at(raw, place * 8) for place in (slots.TOPIC, slots.NODE, slots.OTHER))
    return Snapshot._make(
        (kind, generation, gid, topic, node, other, *values[_COUNTED], values[-1], values[_MOMENTS], raw[_BANKS])
    )


def text_at(raw: bytes, at: int, most: int = slots.NAME_BYTES) -> str:
    """Return the text at a place, which ends with a zero."""
    return raw[at : at + most].split(b"\0", 1)[0].decode("utf-8", "replace")


def _extremes(before: Snapshot | None, after: Snapshot, series: int) -> tuple[float, float]:
    """Return least and greatest of one of the four series since ``before``, infinite where nothing shows them."""
    least, greatest = float("inf"), float("-inf")
    for number in range(max(after.bank - slots.BANKS + 1, before.bank if before else 0), after.bank + 1):
        at = number % slots.BANKS * _BANK_BYTES + series * _EXTREMES.size
        low, high = _EXTREMES.unpack_from(after.banks, at)
        if before is not None and number == before.bank:
            known_low, known_high = _EXTREMES.unpack_from(before.banks, at)
            # What did not change was reported before.
            low, high = (low if low != known_low else least), (high if high != known_high else greatest)
        least, greatest = min(least, low), max(greatest, high)
    return least, greatest


def _moments(before: Snapshot | None, after: Snapshot, series: int) -> Moments:
    """Return the moments of one of the four series since ``before``."""
    at = 3 * series
    known, now = before.moments if before is not None else _NO_MOMENTS, after.moments
    if now[at] <= known[at]:
        return NOTHING
    count = int(now[at] - known[at])
    total, squares = now[at + 1] - known[at + 1], max(now[at + 2] - known[at + 2], 0.0)
    if count == 1:
        return Moments(1, total, squares, total, total)
    mean = total / count
    least, greatest = _extremes(before, after, series)
    # A series whose extremes lie within what had been reported before still has some, on either side of its mean.
    return Moments(count, total, squares, min(least, mean), max(greatest, mean))


def lost_by(moment: Snapshot | None, now_ns: int) -> int:
    """Return how many messages were known to be lost at ``now_ns``."""
    if moment is None or moment.lost < 0:
        return 0
    return moment.lost + (moment.pending if now_ns - moment.pending_since > SETTLE_NS else 0)


def difference(before: Snapshot | None, after: Snapshot, start: float, end: float, lost: int = 0) -> Tally:
    """Return what was counted between two reads of a slot, the names of nodes as they stand in it.

    Args:
        before: the earlier read; None where the slot is new.
        after: the later one.
        start: when the earlier was read, in seconds.
        end: when the later was.
        lost: messages already reported as lost.
    """
    count = after.messages - (before.messages if before else 0)
    period = _moments(before, after, _PERIOD)
    last = after.last * 1e-9
    if not count or after.kind == slots.ANSWERED:
        first = last = 0.0
    elif before is None or not before.messages:
        first = after.first * 1e-9
    elif count == 1:
        first = last
    else:
        # The first of several is not kept: it came about one period after the last before it.
        first = min(last, before.last * 1e-9 + (period.mean or 0.0))
    publisher, subscriber = ("", after.node) if after.kind == slots.TAKEN else (after.node, "")
    known = before.size if before and before.size > 0 else 0
    # By position, which takes half the time of names.
    return Tally(
        after.topic, publisher, subscriber, start, end, count, -1 if after.size < 0 else after.size - known,
        first, last, period, _moments(before, after, _LATENCY), _moments(before, after, _AGE),
        max(0, lost_by(after, int(end * 1e9)) - lost) if after.lost >= 0 else -1,
        Observer.INSIDE, "", _moments(before, after, _PROCESSING),
    )  # fmt: skip
