"""A slot of a counter file at one instant, and what two of them differ in."""

from __future__ import annotations

import struct
from typing import NamedTuple, SupportsBytes

from roslens.live.inside import slots
from roslens.live.inside.sequence import SETTLE_NS
from roslens.model.traffic.tally import NOTHING, Moments, Observer, Tally

_COUNTERS = struct.Struct("=14q" + "qdd" * 4 + "q")
_BANK = struct.Struct("=8d")
_TRIES = 100
_PAIRS = (0, 2, 4, 6)


class Snapshot(NamedTuple):
    """A slot as it was at one instant."""

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
    moments: tuple[tuple[int, float, float], ...]
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
    moments = values[slots.PERIOD : slots.ENDED]
    kind, generation = values[slots.KIND], values[slots.GENERATION]
    if before is not None and before.generation == generation and before.kind == kind:
        gid, topic, node, other = before.gid, before.topic, before.node, before.other
    else:
        gid = raw[slots.GID * 8 : slots.GID * 8 + 24]
        topic, node, other = (text_at(raw, place * 8) for place in (slots.TOPIC, slots.NODE, slots.OTHER))
    return Snapshot(
        kind=kind,
        generation=generation,
        gid=gid,
        topic=topic,
        node=node,
        other=other,
        messages=values[slots.COUNT],
        size=values[slots.BYTES],
        first=values[slots.FIRST],
        last=values[slots.LAST],
        lost=values[slots.LOST],
        pending=values[slots.PENDING],
        pending_since=values[slots.PENDING_SINCE],
        bank=values[slots.BANK],
        ended=values[slots.ENDED],
        moments=(moments[:3], moments[3:6], moments[6:9], moments[9:]),
        banks=raw[slots.BANKS_AT * 8 : (slots.BANKS_AT + slots.BANKS * slots.BANK_WORDS) * 8],
    )


def text_at(raw: bytes, at: int, most: int = slots.NAME_BYTES) -> str:
    """Return the text at a place, which ends with a zero."""
    return raw[at : at + most].split(b"\0", 1)[0].decode("utf-8", "replace")


def _extremes(before: Snapshot | None, after: Snapshot) -> list[tuple[float, float]]:
    """Return least and greatest of each of the four series since ``before``, infinite where nothing shows them."""
    first = max(after.bank - slots.BANKS + 1, before.bank if before else 0)
    found = [float("inf"), float("-inf")] * 4
    for number in range(first, after.bank + 1):
        at = number % slots.BANKS * _BANK.size
        values = _BANK.unpack_from(after.banks, at)
        known = _BANK.unpack_from(before.banks, at) if before and number == before.bank else None
        for index, value in enumerate(values):
            if known is None or value != known[index]:
                found[index] = max(found[index], value) if index % 2 else min(found[index], value)
    return [(found[at], found[at + 1]) for at in _PAIRS]


def _moments(before: Snapshot | None, after: Snapshot) -> list[Moments]:
    if before is not None and before.moments == after.moments:
        return [NOTHING] * len(_PAIRS)
    moments = []
    extremes = _extremes(before, after)
    for index, (least, greatest) in enumerate(extremes):
        count, total, squares = after.moments[index]
        if before is not None:
            known = before.moments[index]
            count, total, squares = count - known[0], total - known[1], squares - known[2]
        if count <= 0:
            moments.append(NOTHING)
            continue
        mean = total / count
        # A series whose extremes lie within what had been reported before still has some, on either side of its mean.
        low, high = (mean, mean) if count == 1 else (min(least, mean), max(greatest, mean))
        moments.append(Moments(int(count), total, max(squares, 0.0), low, high))
    return moments


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
    period, latency, age, processing = _moments(before, after)
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
    taken = after.kind == slots.TAKEN
    known = before.size if before and before.size > 0 else 0
    return Tally(
        after.topic,
        "" if taken else after.node,
        after.node if taken else "",
        start,
        end,
        count=count,
        bytes=-1 if after.size < 0 else after.size - known,
        first=first,
        last=last,
        period=period,
        latency=latency,
        age=age,
        lost=max(0, lost_by(after, int(end * 1e9)) - lost) if after.lost >= 0 else -1,
        observer=Observer.INSIDE,
        processing=processing,
    )
