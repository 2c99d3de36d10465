"""The cache remembers, forgets what may be wrong, and never fails a run."""

import sqlite3
from contextlib import closing

import pytest

from roslens.store.cache import Cache, FileStat
from roslens.store.connect import connect

NOW = 1_700_000_000.0
OLD = FileStat(10, int((NOW - 100) * 1e9), 7, "ab", "cpp", "own", "r1")


@pytest.fixture
def path(tmp_path):
    return tmp_path / ".roslens" / "cache.sqlite"


def test_what_is_put_is_there_the_next_time(path):
    with Cache.open(path) as cache:
        assert cache.stats(now_s=NOW) == {}
        assert cache.get(["a"]) == {}
        cache.put_stats({"src/a.cpp": OLD, "src/b.cpp": OLD}, now_s=NOW)
        cache.put({"a": b"facts", "b": b""})
        cache.put({"a": b"a key always means the same"})
        cache.put({})
    with Cache.open(path) as cache:
        assert cache.stats(now_s=NOW) == {"src/a.cpp": OLD, "src/b.cpp": OLD}
        assert cache.get(["a", "b", "c"]) == {"a": b"facts", "b": b""}
        assert cache.warnings == ()
        assert cache.path == path
    assert (path.parent / ".gitignore").read_text() == "*\n"


def test_many_keys_at_once(path):
    items = {f"key-{number}": bytes([number % 256]) for number in range(1_234)}
    with Cache.open(path) as cache:
        cache.put(items)
        assert cache.get(iter(items)) == items


def test_what_is_known_is_told_without_reading_it(path):
    items = {f"key-{number}": b"" for number in range(1_234)}
    with Cache.open(path) as cache:
        cache.put(items)
        assert cache.known([*items, "other"]) == frozenset(items)
        assert cache.known([]) == frozenset()
    with Cache.open(None) as nothing:
        assert nothing.known(items) == frozenset()


def test_a_stat_is_replaced_and_forgotten(path):
    newer = FileStat(11, OLD.mtime_ns + 1, 7, "cd", "cpp", "own")
    with Cache.open(path) as cache:
        cache.put_stats({"a": OLD, "b": OLD}, now_s=NOW)
        cache.put_stats({"a": newer}, now_s=NOW)
        assert cache.stats(now_s=NOW) == {"a": newer, "b": OLD}
        cache.forget(["b", "\udcff"])
        assert cache.stats(now_s=NOW) == {"a": newer}


@pytest.mark.parametrize(("age_s", "trusted"), [(-5, False), (0, False), (1.9, False), (2.1, True), (3600, True)])
def test_a_file_that_may_still_change_is_not_trusted(path, age_s, trusted):
    stat = FileStat(10, int((NOW - age_s) * 1e9), 7, "ab", "cpp", "own")
    with Cache.open(path) as cache:
        cache.put_stats({"a": OLD}, now_s=NOW)
        cache.put_stats({"a": stat}, now_s=NOW)
        assert cache.stats(now_s=NOW + 60) == ({"a": stat} if trusted else {})


def test_a_clock_that_went_back_is_not_trusted(path):
    with Cache.open(path) as cache:
        cache.put_stats({"a": OLD}, now_s=NOW)
        assert cache.stats(now_s=NOW - 1000) == {}


def test_a_path_that_is_no_utf8_is_looked_at_each_time(path):
    with Cache.open(path) as cache:
        cache.put_stats({"a": OLD, "\udcff": OLD}, now_s=NOW)
        assert cache.stats(now_s=NOW) == {"a": OLD}
        assert cache.warnings == ()


def test_what_was_not_used_for_longest_goes_first(path):
    day = 86_400
    with Cache.open(path, now_s=NOW) as cache:
        cache.put({"a": b"x" * 1000, "b": b"x" * 1000})
    with Cache.open(path, now_s=NOW + day) as cache:
        cache.put({"c": b"x" * 1000, "d": b"x" * 1000})
    with Cache.open(path, now_s=NOW + 2 * day) as cache:
        cache.touch(["a", "no such"])
        assert cache.prune(4000) == 0
        assert cache.prune(2500) == 2
        assert set(cache.get("abcd")) == {"a", "d"}
        assert cache.prune(0) == 2


def test_closing_removes_what_is_too_much(path, monkeypatch):
    monkeypatch.setattr("roslens.store.cache.MAX_BYTES", 100_000)
    with Cache.open(path) as cache:
        for number in range(20):
            cache.put({str(number): b"x" * 50_000})
    assert path.stat().st_size < 300_000
    with Cache.open(path) as cache:
        assert list(cache.get(map(str, range(20)))) == ["18", "19"]


def test_without_a_path_nothing_is_remembered(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with Cache.open(None) as cache:
        cache.put_stats({"a": OLD}, now_s=NOW)
        cache.put({"a": b"x"})
        cache.touch(["a"])
        assert cache.stats(now_s=NOW) == {}
        assert cache.get(["a"]) == {}
        assert cache.prune(0) == 0
        assert cache.warnings == ()
    assert list(tmp_path.iterdir()) == []


def test_a_reader_changes_nothing(path):
    with Cache.open(path) as writer, Cache.open(path, writable=False) as reader:
        writer.put({"a": b"x"})
        assert reader.get(["a"]) == {"a": b"x"}
        reader.put({"b": b"y"})
        reader.put_stats({"a": OLD}, now_s=NOW)
        assert writer.get(["b"]) == {}
        assert writer.stats(now_s=NOW) == {}
        assert reader.warnings == ()


def test_a_reader_of_nothing_finds_nothing(path):
    with Cache.open(path, writable=False) as cache:
        assert cache.get(["a"]) == {}
        assert len(cache.warnings) == 1
    assert not path.exists()


def test_a_file_that_is_no_database_is_made_anew(path):
    path.parent.mkdir()
    path.write_bytes(b"rubbish " * 1000)
    with Cache.open(path, writable=False) as cache:
        assert cache.get(["a"]) == {}
    assert path.read_bytes().startswith(b"rubbish")
    with Cache.open(path) as cache:
        assert cache.stats(now_s=NOW) == {}
        cache.put({"a": b"x"})
        (warning,) = cache.warnings
        assert warning.tool == "cache"
        assert "not a database" in warning.what
        assert "A new one was made" in warning.advice
        assert warning.location.path == str(path)
    with Cache.open(path) as cache:
        assert cache.get(["a"]) == {"a": b"x"}
        assert cache.warnings == ()


def test_a_damaged_file_is_made_anew(path):
    with Cache.open(path) as cache:
        cache.put({f"key-{number}": b"x" * 900 for number in range(200)})
        cache.put_stats({f"src/{number}.cpp": OLD for number in range(2000)}, now_s=NOW)
    content = bytearray(path.read_bytes())
    content[4096:] = b"\xff" * (len(content) - 4096)
    path.write_bytes(content)
    with Cache.open(path) as cache:
        assert cache.stats(now_s=NOW) == {}
        assert "malformed" in cache.warnings[0].what
        cache.put({"a": b"x"})
        assert cache.get(["a"]) == {"a": b"x"}


def test_a_stat_that_cannot_be_read_is_damage(path):
    with Cache.open(path) as cache:
        cache.put_stats({"a": OLD}, now_s=NOW)
    with closing(connect(path, wait_s=1)) as connection:
        connection.execute("UPDATE stat SET stat = x'93'")
    with Cache.open(path) as cache:
        assert cache.stats(now_s=NOW) == {}
        assert len(cache.warnings) == 1
        cache.put_stats({"a": OLD}, now_s=NOW)
        assert cache.stats(now_s=NOW) == {"a": OLD}


def test_the_cache_of_another_version_is_made_anew(path):
    with Cache.open(path) as cache:
        cache.put({"a": b"x"})
    with closing(connect(path, wait_s=1)) as connection:
        connection.execute("PRAGMA user_version = 77")
    with Cache.open(path, writable=False) as cache:
        assert cache.get(["a"]) == {}
    with Cache.open(path) as cache:
        assert cache.get(["a"]) == {}
        assert cache.warnings == ()
        cache.put({"a": b"y"})
        assert cache.get(["a"]) == {"a": b"y"}


def test_a_full_disk_costs_one_warning(path):
    with Cache.open(path) as cache:
        cache.put({"a": b"x"})
        pages = cache._connection.execute("PRAGMA page_count").fetchone()[0]
        cache._connection.execute(f"PRAGMA max_page_count = {pages + 2}")
        cache.put({"b": b"x" * 100_000})
        cache.put({"c": b"x"})
        assert cache.get("abc") == {"a": b"x"}
        (warning,) = cache.warnings
        assert "full" in warning.what
        assert "Results are the same" in warning.advice


def test_a_disk_that_fails_twice_costs_one_warning_too(path):
    class Failing:
        in_transaction = True

        def execute(self, words, *_):
            raise sqlite3.OperationalError("disk I/O error" if words == "ROLLBACK" else "database or disk is full")

        def close(self):
            pass

    with Cache.open(path) as cache:
        cache._connection.close()
        cache._connection = Failing()
        cache.put({"a": b"x"})
        (warning,) = cache.warnings
        assert "full" in warning.what


def test_another_writer_costs_one_warning(path, monkeypatch):
    monkeypatch.setattr("roslens.store.cache_file._WAIT_S", 0.05)
    with Cache.open(path) as cache:
        cache.put({"a": b"x"})
        with closing(sqlite3.connect(path, isolation_level=None)) as other:
            other.execute("BEGIN IMMEDIATE")
            cache.put({"b": b"x"})
            cache.put({"c": b"x"})
            assert cache.get("abc") == {"a": b"x"}
            assert len(cache.warnings) == 1
            other.execute("ROLLBACK")


def test_a_place_where_no_cache_can_be(tmp_path):
    (tmp_path / "blocked").write_text("")
    with Cache.open(tmp_path / "blocked" / "cache.sqlite") as cache:
        cache.put({"a": b"x"})
        assert cache.get(["a"]) == {}
        assert len(cache.warnings) == 1
