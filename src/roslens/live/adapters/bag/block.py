"""How the files of a recording, whatever their format, hand over what they hold: piece by piece, as arrays."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple, Protocol, TypeAlias

import numpy as np
import numpy.typing as npt

from roslens.live.adapters.bag.channel import Channel
from roslens.live.adapters.bag.damage import FailureLog

Ints: TypeAlias = npt.NDArray[np.int64]
Bytes: TypeAlias = npt.NDArray[np.uint8]

NO_STAMP = -(2**63)
FOREVER = 2**63 - 1


class Block(NamedTuple):
    """Messages of one channel in a piece of a file, in the order of the file.

    ``times`` are nanoseconds of receipt, ``sizes`` bytes, ``stamps`` nanoseconds of the header or `NO_STAMP`.
    """

    channel: int
    times: Ints
    sizes: Ints
    stamps: Ints | None = None


class Message(NamedTuple):
    """One message with its bytes; ``time`` is nanoseconds of receipt."""

    time: int
    channel: int
    content: bytes


class Portion(NamedTuple):
    """A piece of the index of a file, read when it is its turn.

    Attributes:
        since: nothing in this or a later portion of the file is earlier; nanoseconds.
        read: returns its messages by channel.
    """

    since: int
    read: Callable[[], list[Block]]


class Load(NamedTuple):
    """A piece of a file whose messages are read when it is its turn; as a `Portion` otherwise."""

    since: int
    read: Callable[[], list[Message]]


class Part(Protocol):
    """One file of a recording.

    ``counts`` are messages by channel as far as known without reading; ``start`` and ``end`` the nanoseconds of the
    first and the last message, ``start > end`` without any.
    """

    path: Path
    generation: str
    channels: Mapping[int, Channel]
    counts: Mapping[int, int]
    start: int
    end: int
    exact_sizes: bool
    failures: FailureLog

    def portions(self, stamped: Collection[int]) -> Iterator[Portion]:
        """Yield the pieces of the index by ``since``; messages of the channels given come with their stamps."""
        ...

    def loads(self, wanted: Collection[int]) -> Iterator[Load]:
        """Yield the messages of some channels in pieces by ``since``."""
        ...
