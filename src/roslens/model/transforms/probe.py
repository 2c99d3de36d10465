"""Whether one frame can be looked up in another, again and again while transforms come in."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec

from roslens.model.transforms.buffer import TransformBuffer
from roslens.model.transforms.lookup import TransformError
from roslens.model.transforms.transform import Transform

EVERY_S = 0.1
"""How often it is tried, on the clock of receipt."""
_SECOND = 1_000_000_000


class Stretch(msgspec.Struct, frozen=True):
    """A time in which look-ups of the newest transform came to the same; times in seconds.

    Attributes:
        since: first try.
        until: last try.
        error: name of the error of tf2 without its end; empty where it was found.
        words: why it failed.
    """

    since: float
    until: float
    error: str = ""
    words: str = ""


class Probed(msgspec.Struct, frozen=True):
    """What all tries came to; times in seconds.

    Attributes:
        stretches: in order.
        margin: median of by how much the newest that both frames have was older than the time of the try: who asks for
            that time has to extrapolate so far. 0 where all is static, or nothing was found.
        widest: the largest of these.
        widest_at: when that was.
    """

    stretches: tuple[Stretch, ...] = ()
    margin: float = 0.0
    widest: float = 0.0
    widest_at: float = 0.0


def probed(transforms: Iterable[Transform], target: str, source: str, end: int) -> Probed:
    """Return what look-ups come to every tenth of a second from the first transform to ``end``, in nanoseconds."""
    tries = list(_tries(transforms, target, source, end))
    stretches: list[Stretch] = []
    margins: list[tuple[float, float]] = []
    for time, error, words, stamp in tries:
        at = time / _SECOND
        if stretches and (stretches[-1].error, stretches[-1].words) == (error, words):
            stretches[-1] = msgspec.structs.replace(stretches[-1], until=at)
        else:
            stretches.append(Stretch(at, at, error, words))
        if not error and stamp:
            margins.append(((time - stamp) / _SECOND, at))
    widest, at = max(margins, default=(0.0, 0.0))
    margins.sort()
    return Probed(tuple(stretches), margins[len(margins) // 2][0] if margins else 0.0, widest, at)


def _tries(transforms: Iterable[Transform], target: str, source: str, end: int) -> Iterator[tuple[int, str, str, int]]:
    """Yield time of the try, error and its words, and the stamp that was found."""
    buffer = TransformBuffer()
    step = round(EVERY_S * _SECOND)
    due = 0
    for one in transforms:
        due = due or one.received + step
        while due <= one.received:
            yield due, *_tried(buffer, target, source)
            due += step
        buffer.put(one)
    while due and due <= end:
        yield due, *_tried(buffer, target, source)
        due += step


def _tried(buffer: TransformBuffer, target: str, source: str) -> tuple[str, str, int]:
    try:
        return "", "", buffer.look_up(target, source).stamp
    except TransformError as error:
        return error.kind, str(error), 0
