"""One SQLite file of a ROS 2 bag, in any of the four schemas that rosbag2 wrote."""

from __future__ import annotations

import sqlite3
from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from contextlib import closing
from functools import partial
from itertools import accumulate, chain, islice, pairwise
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote

import numpy as np

from roslens.live.adapters.bag.block import FOREVER, Block, Ints, Load, Message, Portion
from roslens.live.adapters.bag.channel import Channel, resolved
from roslens.live.adapters.bag.damage import DamageError, FailureLog
from roslens.live.adapters.bag.moments_by_step import edges_of
from roslens.live.adapters.bag.source import Source
from roslens.live.adapters.bag.sqlite_pages import Rows, TablePages
from roslens.live.adapters.bag.stamp import stamps_of

MAGIC = b"SQLite format 3\0"

_ROWS = 1 << 16
_LOADED_ROWS = 64
_HEAD_BYTES = 12
_STOPPED = "Everything before it is read. `sqlite3 FILE .recover` may save more."
_WRONG = (sqlite3.Error, ValueError, OverflowError, TypeError)
_LANGUAGES = {"ros2msg": "msg", "ros2idl": "idl"}


class SqlitePart:
    """A database whose pages are read for topics, times and lengths; messages are asked for where they are wanted.

    A database that is not as rosbag2 leaves it, damaged, or with a log beside it, is asked for everything.

    Raises:
        DamageError: topics cannot be read.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self.generation = "ros2"
        self.exact_sizes = True
        self.failures = FailureLog()
        self.counts: Mapping[int, int] = {}
        self.start, self.end = FOREVER, 0
        self._survey: _Survey | None = None
        try:
            with closing(_connected(path)) as database:
                self.channels: Mapping[int, Channel] = _channels(database)
        except _WRONG as error:
            raise DamageError(f"topics that cannot be read: {error}") from None
        try:
            with closing(_connected(path)) as database:
                try:
                    self._survey = _surveyed(path, database)
                except (DamageError, OSError, *_WRONG):
                    self._count(database)
                else:
                    self.counts, self.start, self.end = self._survey[2:]
                    if missing := self._survey.pages.missing:
                        self._tell(f"a file that was cut off: {missing:,} pages of messages are missing")
        except _WRONG as error:
            self._tell(f"messages that cannot be counted: {error}")

    def _count(self, database: sqlite3.Connection) -> None:
        first = database.execute("SELECT min(timestamp) FROM messages").fetchone()[0]
        last = database.execute("SELECT max(timestamp) FROM messages").fetchone()[0]
        if first is not None:
            self.start, self.end = int(first), int(last)
        counted = database.execute("SELECT topic_id, count(*) FROM messages GROUP BY topic_id").fetchall()
        self.counts = {int(channel): count for channel, count in counted}

    def portions(self, stamped: Collection[int]) -> Iterator[Portion]:
        """Yield topics, times and lengths by time of receipt."""
        if self._survey is not None:
            for since, leaves in zip(self._survey.since, self._survey.pages.windows(), strict=True):
                yield Portion(since, partial(self._read, self._survey.pages, leaves, stamped))
            return
        head = f", substr(data, 1, {_HEAD_BYTES})" if stamped else ""
        query = f"SELECT topic_id, timestamp, length(data){head} FROM messages ORDER BY timestamp"  # noqa: S608 - a constant
        for rows in self._rows(query, [], _ROWS):
            table, heads = self._table(rows)
            if len(table):
                yield Portion(int(table[0, 1]), partial(self._blocks, table, heads, stamped))

    def loads(self, wanted: Collection[int]) -> Iterator[Load]:
        """Yield messages by time of receipt."""
        marks = ", ".join("?" * len(wanted))
        query = f"SELECT topic_id, timestamp, data FROM messages WHERE topic_id IN ({marks}) ORDER BY timestamp"  # noqa: S608 - question marks
        for rows in self._rows(query, sorted(wanted), _LOADED_ROWS):
            found = [Message(time, channel, bytes(content)) for channel, time, content in rows if _right(channel, time)]
            if found:
                yield Load(found[0].time, partial(list, found))

    def _rows(self, query: str, arguments: list[int], size: int) -> Iterator[list[tuple[Any, ...]]]:
        rows: list[tuple[Any, ...]] = []
        try:
            with closing(_connected(self.path)) as database:
                cursor = database.execute(query, arguments)
                while True:
                    rows = []
                    # Unlike fetchmany, this keeps what came before an error.
                    rows.extend(islice(cursor, size))
                    if not rows:
                        return
                    yield rows
        except _WRONG as error:
            self._tell(f"messages that cannot be read: {error}")
        if rows:
            yield rows

    def _table(self, rows: list[tuple[Any, ...]]) -> tuple[Ints, list[bytes]]:
        """Return topics, times and lengths as columns, and the first bytes of messages if they were asked for."""
        heads = [row[3] if isinstance(row[3], bytes) else b"" for row in rows] if len(rows[0]) == 4 else []
        try:
            flat = chain.from_iterable(rows) if not heads else chain.from_iterable(row[:3] for row in rows)
            return np.fromiter(flat, np.int64, 3 * len(rows)).reshape(-1, 3), heads
        except (TypeError, ValueError):
            self._tell("messages whose topic, time or length is not a number")
            kept = [index for index, row in enumerate(rows) if _right(*row[:3])]
            numbers = np.array([rows[index][:3] for index in kept], np.int64).reshape(-1, 3)
            return numbers, [heads[index] for index in kept] if heads else []

    def _blocks(self, table: Ints, heads: list[bytes], stamped: Collection[int]) -> list[Block]:
        blocks = []
        for channel in np.unique(table[:, 0]).tolist():
            if channel not in self.channels:
                self._tell(f"messages of topic {channel}, which is defined nowhere")
                continue
            rows = np.flatnonzero(table[:, 0] == channel)
            stamps = None
            if channel in stamped:
                joined = np.frombuffer(b"".join(heads[row].ljust(_HEAD_BYTES, b"\0") for row in rows), np.uint8)
                starts = np.arange(len(rows), dtype=np.int64) * _HEAD_BYTES
                stamps = stamps_of(joined, starts, table[rows, 2], self.channels[channel])
            blocks.append(Block(channel, table[rows, 1], table[rows, 2], stamps))
        return blocks

    def _read(self, pages: TablePages, leaves: Ints, stamped: Collection[int]) -> list[Block]:
        """Return what leaves of the table hold, topic by topic."""
        try:
            rows = pages.rows(leaves)
        except DamageError as damage:
            self._tell(f"pages that changed while they were read: {damage}")
            return []
        blocks = []
        for channel, mine in _by_channel(rows):
            if channel not in self.channels:
                self._tell(f"messages of topic {channel}, which is defined nowhere")
                continue
            sizes = rows.sizes[mine]
            stamps = None
            if channel in stamped:
                stamps = stamps_of(rows.content, rows.starts[mine], sizes, self.channels[channel])
            blocks.append(Block(channel, rows.times[mine], sizes, stamps))
        return blocks

    def _tell(self, what: str) -> None:
        self.failures.add(self.path, what, advice=_STOPPED)


class _Survey(NamedTuple):
    """What the leaves of the table hold: since when each window of them and all later ones, and how much of what."""

    pages: TablePages
    since: list[int]
    counts: dict[int, int]
    start: int
    end: int


def _surveyed(path: Path, database: sqlite3.Connection) -> _Survey:
    """Look at all leaves of the table of messages once.

    Raises:
        DamageError: something is not as expected.
    """
    columns = [row[1] for row in database.execute("PRAGMA table_info(messages)")]
    if columns != ["id", "topic_id", "timestamp", "data"] or _logged(path):
        raise DamageError(f"columns {columns} or a log")
    root = database.execute("SELECT rootpage FROM sqlite_master WHERE name = 'messages'").fetchone()[0]
    pages = TablePages(Source(path), int(root))
    counts: Counter[int] = Counter()
    since = []
    last = 0
    for leaves in pages.windows():
        rows = pages.rows(leaves)
        since.append(int(rows.times.min(initial=FOREVER)))
        last = max(last, int(rows.times.max(initial=0)))
        channels, counted = np.unique(rows.channels, return_counts=True)
        counts.update(dict(zip(channels.tolist(), counted.tolist(), strict=True)))
    # What comes in a later window may be earlier.
    since = list(accumulate(reversed(since), min))[::-1]
    return _Survey(pages, since, dict(counts), since[0] if since else FOREVER, last)


def _by_channel(rows: Rows) -> Iterator[tuple[int, Ints]]:
    """Yield the places of the rows of each channel."""
    channels = rows.channels
    if len(channels) and int(channels.min()) >= 0 and int(channels.max()) < 1 << 16:
        channels = channels.astype(np.uint16)  # sorted by digits, several times faster
    order = np.argsort(channels, kind="stable")
    edges = [*edges_of(channels[order]).tolist(), len(order)]
    for begin, end in pairwise(edges):
        mine = order[begin:end]
        yield int(rows.channels[mine[0]]), mine


def _right(*numbers: object) -> bool:
    return all(type(number) is int for number in numbers)


def _logged(path: Path) -> bool:
    """Return whether a killed recorder left a log beside a database."""
    log = path.with_name(path.name + "-wal")
    return log.exists() and log.stat().st_size > 0


def _connected(path: Path) -> sqlite3.Connection:
    """Open a database without writing beside it, unless a killed recorder left a log that belongs to it."""
    mode = "mode=ro" if _logged(path) else "immutable=1"
    database = sqlite3.connect(f"file:{quote(str(path.absolute()))}?{mode}", uri=True, check_same_thread=False)
    database.text_factory = lambda content: content.decode(errors="replace")
    try:
        # What a database defines itself, such as views or functions in them, is not run.
        database.execute("PRAGMA trusted_schema = OFF")
        # Nothing is written; without this a file that was cut off is refused as a whole.
        database.execute("PRAGMA writable_schema = ON")
        tables = database.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall()
    except BaseException:
        database.close()
        raise
    if not {("messages",), ("topics",)} <= set(tables):
        database.close()
        raise ValueError('no tables "messages" and "topics"')
    return database


def _channels(database: sqlite3.Connection) -> dict[int, Channel]:
    tables = {name for (name,) in database.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
    definitions: dict[str, tuple[str, str]] = {}
    if "message_definitions" in tables:
        query = "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions"
        definitions = {_text(name): (_text(encoding), _text(text)) for name, encoding, text in database.execute(query)}
    # SQLite finds a column whatever the case of its name.
    columns = [_text(row[1]).lower() for row in database.execute("PRAGMA table_info(topics)")]
    if "id" not in columns:
        raise ValueError("topics have no column `id`")
    channels = {}
    for row in database.execute("SELECT * FROM topics ORDER BY id"):
        values = dict(zip(columns, row, strict=True))
        kind = _text(values.get("type"))
        encoding, definition = definitions.get(kind, ("", ""))
        channels[int(values["id"])] = Channel(
            resolved(_text(values.get("name"))),
            kind,
            _text(values.get("type_description_hash")),
            "",
            _text(values.get("offered_qos_profiles")),
            definition,
            _LANGUAGES.get(encoding, ""),
            _text(values.get("serialization_format")),
        )
    return channels


def _text(value: object) -> str:
    return value if isinstance(value, str) else ""
