"""What something else puts into a cache is not used: it is made again, and said."""

import sqlite3
from contextlib import closing

import pytest

from roslens.store.cache import Cache, FileStat

NOW = 1_000_000.0
STAT = FileStat(1, 2, 3, "hash", "cpp", "own")


@pytest.fixture
def path(tmp_path):
    place = tmp_path / "cache.sqlite"
    with Cache.open(place) as cache:
        cache.put({"a": b"one", "b": b"other"})
        cache.put_stats({"a.cpp": STAT, "b.cpp": STAT}, now_s=NOW)
    return place


def execute(path, statement):
    with closing(sqlite3.connect(path)) as connection:
        connection.execute(statement)
        connection.commit()


FORGERIES = {
    "changed": "UPDATE blob SET content = x'00112233445566778899aabbccddeeff' || x'20' WHERE number = 1",
    "of another key": "UPDATE blob SET content = (SELECT content FROM blob WHERE number = 2) WHERE number = 1",
    "too short": "UPDATE blob SET content = x'00' WHERE number = 1",
    "a text": "UPDATE blob SET content = 'text' WHERE number = 1",
    "a number": "UPDATE blob SET content = 7 WHERE number = 1",
}


@pytest.mark.parametrize("forgery", FORGERIES)
def test_a_changed_entry_is_not_used_and_made_again(path, forgery):
    execute(path, FORGERIES[forgery])
    with Cache.open(path) as cache:
        assert cache.known(["a", "b"]) == {"b"}
        assert cache.get(["a", "b"]) == {"b": b"other"}
        (warning,) = cache.warnings
        assert "of the entries in the cache were changed by something other than roslens of this user" in str(warning)
        cache.put({"a": b"one"})
    with Cache.open(path) as cache:
        assert cache.get(["a", "b"]) == {"a": b"one", "b": b"other"}
        assert cache.warnings == ()


def test_an_inserted_entry_is_not_used(path):
    execute(path, "INSERT INTO facts VALUES ('c', 1, 0, 9)")
    execute(path, "INSERT INTO blob VALUES (9, x'20')")
    with Cache.open(path) as cache:
        assert cache.get(["c"]) == {}


def test_what_is_known_of_a_path_is_that_path_s(path):
    execute(path, "UPDATE stat SET path = 'c.cpp' WHERE path = 'b.cpp'")
    with Cache.open(path) as cache:
        assert cache.stats(now_s=NOW) == {"a.cpp": STAT}
        cache.put_stats({"c.cpp": STAT}, now_s=NOW)
    with Cache.open(path) as cache:
        assert cache.stats(now_s=NOW) == {"a.cpp": STAT, "c.cpp": STAT}


def test_a_cache_of_another_user_opens_nothing(path, monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "other"))
    with Cache.open(path) as cache:
        assert cache.get(["a", "b"]) == {}
        assert cache.stats(now_s=NOW) == {}
