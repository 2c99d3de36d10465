"""The rows of a table of messages, straight from the pages of a SQLite file and thousands at a time.

The format is https://www.sqlite.org/fileformat2.html. Of a message only what stands in the leaf of the table's tree is
read, never the pages that a long one overflows into. Whatever is not as rosbag2 writes it is refused, and left to
SQLite itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from roslens.live.adapters.bag.block import Bytes, Ints
from roslens.live.adapters.bag.damage import DamageError
from roslens.live.adapters.bag.source import Source

_LEAF, _INTERIOR = 0x0D, 0x05
_LEAF_HEAD, _INTERIOR_HEAD = 8, 12
_LEAST_PAGE = 1024
"""The first 37 bytes of a row lie in its leaf in pages of 512 bytes, and always more in longer ones."""
_NEAR_BYTES = 12
_NEAR_PAGES = 8
"""Leaves that lie so near to each other are read at once, with what is in between."""
_DEEPEST = 20
_WINDOW_BYTES = 1 << 20
_PADDING = 64
"""Zeros behind the pages, so that words at a last cell that lies about itself can be read."""

_STOPS = np.uint64(0x8080808080808080).astype(np.int64)
_WIDTHS = np.array([0, 1, 2, 3, 4, 6, 8, 0, 0, 0], np.int64)
_NULL, _EIGHT_BYTES, _FLOAT, _ZERO, _ONE, _BLOB = 0, 6, 7, 8, 9, 12
_FIXED_BITS = 32
"""Of a row's own header before the length of its content: the header's length, and kinds of three columns."""


class Rows(NamedTuple):
    """Rows of the table in the order of their numbers.

    ``content`` are bytes in which messages begin at ``starts``; of each at least the first 12 are there.
    """

    channels: Ints
    times: Ints
    sizes: Ints
    content: Bytes
    starts: Ints


class TablePages:
    """The leaves of a table with the columns id, topic, time and content.

    Of a file that was cut off, those that are there.

    Args:
        source: the file.
        root: number of the page at the root of the table's tree.

    Attributes:
        missing: how many pages of the tree the file ends before, those below missing ones not counted.

    Raises:
        DamageError: the tree is not as expected.
    """

    def __init__(self, source: Source, root: int) -> None:
        self._source = source
        self.missing = 0
        head = source.read(0, 100)
        page = int.from_bytes(head[16:18], "big")
        self._page = 1 << 16 if page == 1 else page
        self._usable = self._page - head[20]
        if self._page < _LEAST_PAGE or self._page & (self._page - 1) or self._usable < _LEAST_PAGE - 32:
            raise DamageError(f"pages of {self._page:,} bytes")
        self._leaves = self._leaves_below(root)

    def windows(self) -> Iterator[Ints]:
        """Yield the numbers of the leaves, as many at a time as are read at once."""
        many = max(_WINDOW_BYTES // self._page, 1)
        for at in range(0, len(self._leaves), many):
            yield self._leaves[at : at + many]

    def rows(self, leaves: Ints) -> Rows:
        """Return what leaves hold.

        Raises:
            DamageError: a row is not as expected.
        """
        content, starts = self._read(leaves)
        cells, bases = self._cells(content, starts, _LEAF, _LEAF_HEAD)
        words = np.ndarray((len(content) - 7,), np.dtype(">i8"), content, strides=(1,))
        first = _taken(words, cells)
        payload_bytes = _lengths(first)
        payload = _varints(first, payload_bytes)
        row_at = cells + payload_bytes
        row_at += _lengths(first << 8 * payload_bytes)
        head = _taken(words, row_at)
        header = head >> 56
        serial = _varints(head << _FIXED_BITS, header - _FIXED_BITS // 8)
        sizes = (serial - _BLOB) >> 1
        at = row_at + header
        channels, at = _channels(words, head, at)
        times, at = _times(words, head, at)
        right = (head >> 48) & 0xFF == _NULL
        right &= (serial >= _BLOB) & (serial & 1 == 0)
        right &= at - row_at + sizes == payload
        right &= at - bases + np.minimum(sizes, _NEAR_BYTES) <= self._usable
        if not right.all():
            raise DamageError("rows of another kind")
        return Rows(channels, times, sizes, content, at)

    def _leaves_below(self, root: int) -> Ints:
        level = np.array([root], np.int64)
        for _ in range(_DEEPEST):
            if self._kind(int(level[0])) == _LEAF:
                return level
            children = self._children(*self._read(level))
            level = children[children * self._page <= self._source.size]
            if len(level) * self._page > self._source.size:
                break
            if len(level) < len(children):
                self.missing += len(children) - len(level)
                if not len(level) or self._kind(int(level[0])) != _LEAF:
                    # Pages between root and leaves are written late: those below the missing ones are looked for.
                    return self._leaves_anywhere()
        raise DamageError("a tree that does not end")

    def _kind(self, page: int) -> int:
        return self._source.read(self._place(page), 1)[0]

    def _leaves_anywhere(self) -> Ints:
        """Return the pages that hold rows of messages and nothing else, wherever they belong."""
        found = []
        for page in range(2, self._source.size // self._page + 1):
            if self._kind(page) != _LEAF:
                continue
            with suppress(DamageError):
                self.rows(np.array([page], np.int64))
                found.append(page)
        return np.array(found, np.int64)

    def _children(self, content: Bytes, starts: Ints) -> Ints:
        """Return the pages below interior pages, in order: those of the cells, and at the end of each the last."""
        cells, _ = self._cells(content, starts, _INTERIOR, _INTERIOR_HEAD)
        numbers = np.ndarray((len(content) - 3,), np.dtype(">u4"), content, strides=(1,))
        ends = np.cumsum(_counts(content, starts))
        return np.insert(numbers[cells].astype(np.int64), ends, numbers[starts + 8].astype(np.int64))

    def _cells(self, content: Bytes, starts: Ints, kind: int, head: int) -> tuple[Ints, Ints]:
        """Return where the cells of the pages that begin at ``starts`` lie, and where the page of each begins."""
        counts = _counts(content, starts)
        if (content[starts] != kind).any() or head + 2 * int(counts.max()) > self._usable:
            raise DamageError("pages of another kind")
        bases = np.repeat(starts, counts)
        befores = np.repeat(np.cumsum(counts) - counts, counts)
        pointers = np.ndarray((len(content) - 1,), np.dtype(">u2"), content, strides=(1,))
        places = pointers[bases + head + 2 * (np.arange(len(bases)) - befores)].astype(np.int64)
        if len(places) and (int(places.min()) < head or int(places.max()) > self._usable - 4):
            raise DamageError("cells outside of their page")
        return bases + places, bases

    def _read(self, numbers: Ints) -> tuple[Bytes, Ints]:
        """Return pages, with others that lie in between, and where each begins."""
        size = self._page
        leaps = np.diff(numbers)
        far = (leaps < 1) | (leaps > _NEAR_PAGES)
        places = (np.cumsum(np.where(far, 1, leaps)) if len(leaps) else leaps) * size
        starts = np.concatenate([np.zeros(1, np.int64), places])
        content = np.empty(int(starts[-1]) + size + _PADDING, np.uint8)
        content[-_PADDING:] = 0
        view = content.data
        edges = [0, *(np.flatnonzero(far) + 1).tolist()]
        ends = [*starts[edges[1:]].tolist(), len(content) - _PADDING]
        for first, end in zip(edges, ends, strict=True):
            self._source.fill(self._place(int(numbers[first])), view[int(starts[first]) : end])
        return content, starts

    def _place(self, number: int) -> int:
        return (number - 1) * self._page


def _counts(content: Bytes, starts: Ints) -> Ints:
    """Return the number of cells of pages."""
    return content[starts + 3].astype(np.int64) << 8 | content[starts + 4]


def _taken(words: Ints, at: Ints) -> Ints:
    return words[at].astype(np.int64)


def _lengths(words: Ints) -> Ints:
    """Return how many bytes the variable-length integers have with which the words begin."""
    stops = (~words & _STOPS).view(np.uint64)
    lengths = np.ones(len(words), np.int64)
    for bit in range(63, 0, -8):
        longer = stops < np.uint64(1 << bit)
        if not longer.any():
            return lengths
        lengths += longer
    raise DamageError("an integer of nine bytes")


def _varints(words: Ints, lengths: Ints) -> Ints:
    """Return the variable-length integers, of one to four bytes, with which the words begin."""
    if len(lengths) and not 1 <= int(lengths.min()) <= int(lengths.max()) <= 4:
        raise DamageError("a length beyond 2^28")
    raw = (words.view(np.uint64) >> (64 - 8 * lengths).view(np.uint64)).view(np.int64)
    value = raw & 0x7F
    for byte in range(1, int(lengths.max(initial=1))):
        value |= (raw >> byte) & (0x7F << 7 * byte)
    return value


def _channels(words: Ints, head: Ints, at: Ints) -> tuple[Ints, Ints]:
    """Return the second column, whose value in one byte mostly lies in the word of the header, and where it ends."""
    kinds = (head >> 40) & 0xFF
    single = kinds == 1
    if (single | (kinds == _ONE)).all() and (head >> 56 < 8).all():
        value = (head << 8 * (head >> 56)) >> 56
        return np.where(single, value, 1), at + single
    return _integers(words, at, kinds)


def _times(words: Ints, head: Ints, at: Ints) -> tuple[Ints, Ints]:
    """Return the third column, which mostly has eight bytes, and where it ends."""
    kinds = (head >> 32) & 0xFF
    if (kinds == _EIGHT_BYTES).all():
        return _taken(words, at), at + 8
    return _integers(words, at, kinds)


def _integers(words: Ints, at: Ints, kinds: Ints) -> tuple[Ints, Ints]:
    """Return signed integers and where they end."""
    if len(kinds) and (int(kinds.min()) == _NULL or int(kinds.max()) > _ONE or bool((kinds == _FLOAT).any())):
        raise DamageError("rows of another kind")
    widths = _WIDTHS[kinds]
    found = _taken(words, at) >> np.minimum(64 - 8 * widths, 63)
    return np.where(widths == 0, kinds - _ZERO, found), at + widths
