"""What a file format must provide so that its chunks can be read."""

from __future__ import annotations

from typing import NamedTuple, Protocol, TypeVar

import numpy as np
import numpy.typing as npt

from roslens.live.adapters.bag.block import Bytes, Ints
from roslens.live.adapters.bag.channel import Channel

_Number = TypeVar("_Number", bound=np.generic)


class Entries(NamedTuple):
    """The index of one channel in one chunk: nanoseconds, and where each record begins in the unpacked chunk."""

    channel: int
    times: Ints
    offsets: Ints


class Walk(NamedTuple):
    """The messages that a walk over the records of a chunk found.

    ``starts`` and ``sizes`` say where the content of a message lies; ``stopped`` why the walk ended early, or nothing.
    """

    channels: Ints
    times: Ints
    starts: Ints
    sizes: Ints
    stopped: str = ""


class Layout(Protocol):
    """A format of chunks and their index; knows the channels that were defined so far."""

    channels: dict[int, Channel]
    overhead: int

    def entries(self, region: bytes) -> list[Entries]:
        """Read the index records that follow a chunk.

        Raises:
            DamageError: these are no index records.
        """
        ...

    def locate(self, content: Bytes, offsets: Ints) -> tuple[Ints, Ints] | None:
        """Return start and size of the messages whose records begin at the offsets; None if some are no messages."""
        ...

    def walk(self, content: bytes) -> Walk:
        """Read a chunk record by record, without an index; learns the channels defined in it."""
        ...


def cut(channels: list[tuple[int, int]], times: Ints, offsets: Ints) -> list[Entries]:
    """Return the columns of channels that follow each other, given how many each has, channel by channel."""
    found = []
    begin = 0
    for channel, count in channels:
        end = begin + count
        found.append(Entries(channel, times[begin:end], offsets[begin:end]))
        begin = end
    return found


def numbers_at(content: Bytes, at: Ints, kind: type[_Number]) -> npt.NDArray[_Number]:
    """Return the little-endian numbers at any places of the content."""
    width = np.dtype(kind).itemsize
    if not len(at):
        return np.zeros(0, kind)
    # A view with a number at every byte: picking from it is several times faster than picking bytes.
    everywhere: npt.NDArray[_Number] = np.ndarray(
        (len(content) - width + 1,), np.dtype(kind).newbyteorder("<"), content, strides=(1,)
    )
    return everywhere[at].astype(kind, copy=False)


def walked(rows: list[tuple[int, int, int, int]], stopped: str) -> Walk:
    """Return rows of channel, time, start and size as a walk."""
    table = np.array(rows, np.int64).reshape(-1, 4)
    return Walk(table[:, 0], table[:, 1], table[:, 2], table[:, 3], stopped)
