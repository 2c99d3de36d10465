"""Rows read from pages are those that SQLite reads."""

import random
import sqlite3
from contextlib import closing

import numpy as np
import pytest

from roslens.live.adapters.bag.damage import DamageError
from roslens.live.adapters.bag.open_bag import open_bag
from roslens.live.adapters.bag.source import Source
from roslens.live.adapters.bag.sqlite import SqlitePart
from roslens.live.adapters.bag.sqlite_pages import TablePages

TABLE = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)"
START = 1_700_000_000_000_000_000


def written(path, rows, page=4096, table=TABLE):
    with closing(sqlite3.connect(path)) as database:
        database.execute(f"PRAGMA page_size = {page}")
        database.execute(table)
        database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)")
        database.executemany("INSERT INTO topics VALUES (?, ?, 'a/msg/B', 'cdr')", [(1, "/a"), (2, "/b")])
        database.executemany("INSERT INTO messages VALUES (?, ?, ?, ?)", rows)
        database.commit()
        query = "SELECT rootpage FROM sqlite_master WHERE name = 'messages'"
        root = database.execute(query).fetchone()[0]
        query = "SELECT topic_id, timestamp, length(data), coalesce(substr(data, 1, 12), x'') FROM messages ORDER BY id"
        return root, database.execute(query).fetchall()


def read(path, root):
    pages = TablePages(Source(path), root)
    found = []
    for leaves in pages.windows():
        rows = pages.rows(leaves)
        for channel, time, size, at in zip(*(column.tolist() for column in (*rows[:3], rows.starts)), strict=True):
            found.append((channel, time, size, rows.content[at : at + min(size, 12)].tobytes()))
    return found


@pytest.mark.parametrize("page", [1024, 4096, 65536])
@pytest.mark.parametrize("seed", range(4))
def test_rows_of_all_widths_are_read(tmp_path, page, seed, monkeypatch):
    monkeypatch.setattr("roslens.live.adapters.bag.sqlite_pages._WINDOW_BYTES", random.Random(seed).choice([1, 9999]))
    chance = random.Random(seed * 7 + page)
    topics = [1, 2, 40] if seed else [0, 1, 2, 127, 128, 300, 70_000, 1 << 23, 1 << 40, -3]
    times = [0, 1, 200, 1 << 20, 1 << 30, 1 << 44, START, -START]
    number, rows = 0, []
    for _ in range(1500):
        number += chance.choice([1, 1, 1, 200, 40_000])
        size = chance.choice([0, 1, 11, 12, 50, 57, 60, 900, page, 3 * page]) if seed > 1 else chance.randrange(120)
        time = chance.choice(times) + chance.randrange(100)
        rows.append((number, chance.choice(topics), time, chance.randbytes(size)))
    root, expected = written(tmp_path / "x.db3", rows, page)
    assert read(tmp_path / "x.db3", root) == expected


def test_a_table_without_rows_has_none(tmp_path):
    root, _ = written(tmp_path / "x.db3", [])
    assert read(tmp_path / "x.db3", root) == []


@pytest.mark.parametrize(
    "row", [(3, 1, START, "text"), (3, 1, START, None), (3, 1, 0.5, b""), (3, None, START, b""), (3, "a", START, b"")]
)
def test_rows_of_another_kind_are_refused(tmp_path, row):
    root, _ = written(tmp_path / "x.db3", [(1, 1, START, b"a"), row])
    with pytest.raises(DamageError, match="of another kind"):
        read(tmp_path / "x.db3", root)


def test_other_tables_and_pages_are_refused(tmp_path):
    root, _ = written(tmp_path / "x.db3", [(1, 1, START, b"a")], table=TABLE + " WITHOUT ROWID")
    with pytest.raises(DamageError):
        read(tmp_path / "x.db3", root)
    root, _ = written(tmp_path / "y.db3", [(1, 1, START, b"a")], page=512)
    with pytest.raises(DamageError, match="pages of 512 bytes"):
        read(tmp_path / "y.db3", root)


def rows_in_disorder(count=3000):
    chance = random.Random(5)
    return [(n + 1, 1 + n % 2, START + n * 1000 - chance.choice([0, 900_000]), bytes(n % 90)) for n in range(count)]


def blocks_of(part):
    found = [(portion.since, portion.read()) for portion in part.portions(())]
    for index, (since, _) in enumerate(found):
        assert all(block.times.min() >= since for _, blocks in found[index:] for block in blocks)
    rows = {}
    for _, blocks in found:
        for block in blocks:
            rows.setdefault(block.channel, []).extend(zip(block.times.tolist(), block.sizes.tolist(), strict=True))
    return {channel: sorted(each) for channel, each in rows.items()}


def test_a_database_is_read_by_its_pages_as_by_questions(tmp_path, monkeypatch):
    monkeypatch.setattr("roslens.live.adapters.bag.sqlite_pages._WINDOW_BYTES", 1 << 14)
    written(tmp_path / "x.db3", rows_in_disorder())
    part = SqlitePart(tmp_path / "x.db3")
    assert part._survey is not None
    by_pages = blocks_of(part)
    assert len(part._survey.since) > 5
    monkeypatch.setattr("roslens.live.adapters.bag.sqlite.TablePages", None)
    monkeypatch.setattr("roslens.live.adapters.bag.sqlite._logged", lambda _: True)
    asked = SqlitePart(tmp_path / "x.db3")
    assert asked._survey is None
    assert by_pages == blocks_of(asked)
    assert (part.counts, part.start, part.end) == (asked.counts, asked.start, asked.end)


def test_what_stands_in_a_log_is_read(tmp_path):
    path = tmp_path / "x.db3"
    written(path, rows_in_disorder(10))
    with closing(sqlite3.connect(path)) as database:
        database.execute("PRAGMA journal_mode = WAL")
        database.execute("INSERT INTO messages VALUES (99, 1, 5, x'00')")
        database.commit()
        part = SqlitePart(path)
        assert part._survey is None
        assert sum(part.counts.values()) == 11


def test_a_database_that_shrinks_while_it_is_read_is_told(tmp_path):
    path = tmp_path / "x.db3"
    written(path, rows_in_disorder())
    bag = open_bag(path)
    with path.open("r+b") as file:
        file.truncate(4096)
    assert list(bag.tallies())
    assert "pages that changed while they were read" in " ".join(failure.what for failure in bag.failures)


def test_only_leaves_are_read(tmp_path, monkeypatch):
    path = tmp_path / "x.db3"
    root, _ = written(path, [(n + 1, 1, START + n, bytes(200_000)) for n in range(30)])
    filled = []
    fill = Source.fill
    monkeypatch.setattr(Source, "fill", lambda self, at, place: (filled.append(len(place)), fill(self, at, place))[1])
    assert np.unique([row[2] for row in read(path, root)]).tolist() == [200_000]
    assert sum(filled) < path.stat().st_size / 20
