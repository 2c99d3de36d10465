"""Who changes a store without its key is found out when it is opened, and the store is set aside."""

import json
import os
import shutil
import sqlite3
from contextlib import closing

import pytest

from roslens.store.migrate import SCHEMA
from roslens.store.runs import Store
from roslens.store.sealing import sealing as module
from roslens.store.sealing.sealing import Sealing

OLD = sorted((SCHEMA.parents[3] / "tests" / "fixtures" / "stores").glob("schema_*.sql"))


@pytest.fixture
def said():
    return []


@pytest.fixture
def opened(tmp_path, said):
    def open_it(key=b"k" * 32, *, adopts=False, path=tmp_path / "store.sqlite"):
        return Store.open(path, sealing=Sealing(key, adopts, said.append))

    return open_it


@pytest.fixture
def kept(opened, tmp_path, write_small):
    """Return a store with two runs, closed."""
    with opened() as store:
        write_small(store, "key-1")
        write_small(store, "key-2")
    return tmp_path / "store.sqlite"


def execute(path, *statements):
    with closing(sqlite3.connect(path)) as connection:
        for one in statements:
            connection.execute(one)
        connection.commit()


def latest(opened, **more):
    with opened(**more) as store:
        return store.latest()


FORGERIES = {
    "finding removed": "DELETE FROM finding WHERE position = 0",
    "finding changed": "UPDATE finding SET severity = 'note'",
    "finding inserted": "INSERT INTO finding SELECT unit, position + 99, rule, severity, message, path, line, "
    '"column", end_line, end_column, entity, tag_set, tool, fingerprint, quantity, value, bound, model, gated, '
    "witnesses, others, edits, consequence, certainty FROM finding",
    "failure removed": "DELETE FROM failure",
    "measured changed": "UPDATE measured SET \"values\" = '[1]'",
    "summary changed": "UPDATE unit SET summary = '{}'",
    "tags changed": "UPDATE tag_set SET tags = '[]' WHERE id = 1",
    "run removed": "DELETE FROM run WHERE id = 2",
    "run changed": "UPDATE run SET findings = 0",
    "run inserted": 'INSERT INTO run SELECT 9, key, root, paths, started, seconds, "commit", tools, configuration, '
    "models, vocabulary, workspace, packages, files, entities, findings, failures, repositories, graphs FROM run "
    "WHERE id = 2",
    "unit of a run": "UPDATE run_unit SET unit = 1",
    "rules changed": "UPDATE vocabulary SET rules = '[]'",
    "unit inserted": "INSERT INTO unit (key, package) VALUES ('x', 'p')",
    "unit renamed": "UPDATE unit SET key = 'other' WHERE id = 1",
    "seal removed": "DELETE FROM seal WHERE kind = 'unit'",
    "head removed": "DELETE FROM seal WHERE kind = 'head'",
    "seals removed": "DROP TABLE seal",
    "seals of another form": "ALTER TABLE seal RENAME COLUMN digest TO other",
    "seal of another type": "UPDATE seal SET number = 'x' WHERE kind = 'head'",
    "a trigger": "CREATE TRIGGER t AFTER INSERT ON finding BEGIN DELETE FROM finding; END",
    "an earlier schema": "PRAGMA user_version = 3",
    "a later schema": "PRAGMA user_version = 99",
    "another program": "PRAGMA application_id = 1",
}


def test_what_was_written_is_read_again(kept, opened, said):
    assert latest(opened) == 2
    (kept.parent / "store.sqlite.seal").unlink()
    assert latest(opened) == 2
    with opened() as store:
        assert store.prune(1) == 1
    (kept.parent / "store.sqlite.seal").unlink()
    with opened() as store:
        assert [one.id for one in store.runs()] == [2]
        assert store.view().packages()
    assert said == []


@pytest.mark.parametrize("forgery", FORGERIES)
def test_a_change_without_the_key_is_found(kept, opened, said, forgery, write_small):
    execute(kept, FORGERIES[forgery])
    with opened() as store:
        assert store.latest() is None
        write_small(store, "key-3")
    assert len(said) == 1
    assert (
        "was changed by something other than roslens of this user: it is set aside as 'store.set-aside-1.sqlite'"
        in said[0]
    )
    assert (kept.parent / "store.set-aside-1.sqlite").is_file()
    assert latest(opened) == 1
    assert len(said) == 1


def test_an_index_that_hides_a_row_is_found(kept, opened, said):
    with closing(sqlite3.connect(kept)) as connection:
        # The rows of the table are as they were; the index no longer has them.
        (root,) = connection.execute("SELECT rootpage FROM sqlite_master WHERE name = 'finding_rule'").fetchone()
        (size,) = connection.execute("PRAGMA page_size").fetchone()
    with kept.open("r+b") as file:
        file.seek((root - 1) * size + 3)
        file.write(bytes(2))
    assert latest(opened) is None
    assert len(said) == 1


@pytest.mark.parametrize("content", [b"", b"no database", None])
def test_a_file_that_is_no_whole_database_is_set_aside(kept, opened, said, content):
    whole = kept.read_bytes()
    kept.write_bytes(whole[: len(whole) // 2] if content is None else content)
    assert latest(opened) is None
    assert len(said) == (content != b"")


@pytest.mark.parametrize("key", [b"x" * 32, b""])
def test_a_store_of_another_key_opens_nothing(kept, opened, said, key):
    assert latest(opened, key=key) is None
    assert len(said) == 1
    # Nor does what stands beside it, copied from one that is whole.
    assert (kept.parent / "store.sqlite.seal").is_file()


def test_a_log_beside_the_file_counts(kept, opened, said):
    """What a killed process left is read with the store; what somebody else puts there is found."""
    with closing(sqlite3.connect(kept)) as other:
        other.execute("DELETE FROM finding")
        other.commit()
        for ending in ("", "-wal"):
            shutil.copy(f"{kept}{ending}", kept.parent / f"copy{ending}")
    other_place = kept.parent / "other"
    other_place.mkdir()
    for ending in ("", "-wal"):
        (kept.parent / f"copy{ending}").rename(other_place / f"store.sqlite{ending}")
    assert (other_place / "store.sqlite-wal").stat().st_size
    assert latest(opened, path=other_place / "store.sqlite") is None
    assert len(said) == 1


def test_a_killed_writer_leaves_the_run_before(kept, opened, said, write_small):
    store = opened()
    write_small(store, "key-3")
    place = kept.parent / "killed"
    place.mkdir()
    for ending in ("", "-wal"):
        shutil.copy(f"{kept}{ending}", place / f"store.sqlite{ending}")
    store.close()
    assert (place / "store.sqlite-wal").stat().st_size, "it was not closed"
    assert latest(opened, path=place / "store.sqlite") == 3
    assert said == []


def test_two_writers_at_once(kept, opened, said, write_small):
    with opened() as one, opened() as other:
        write_small(one, "key-3")
        write_small(other, "key-4")
        write_small(one, "key-5")
    with opened() as store:
        assert [run.id for run in store.runs()] == [5, 4, 3, 2, 1]
    assert said == []


def test_what_something_else_changes_while_it_is_open_is_found_next_time(kept, opened, said, write_small):
    with opened() as store:
        execute(kept, "UPDATE finding SET severity = 'note'")
        write_small(store, "key-3")
    assert latest(opened) is None
    assert len(said) == 1


def test_a_whole_store_is_read_once(kept, opened, monkeypatch):
    asked = []
    plain = module.is_as_sealed
    monkeypatch.setattr(module, "is_as_sealed", lambda *words: asked.append(words) or plain(*words))
    latest(opened)
    assert asked == [], "it is as it was closed"
    os.utime(kept)
    latest(opened)
    latest(opened)
    assert len(asked) == 1


def test_what_an_earlier_version_left_is_signed_and_said_so(tmp_path, opened, said):
    for number, dump in enumerate(OLD):
        path = tmp_path / f"{number}.sqlite"
        with closing(sqlite3.connect(path)) as connection:
            connection.executescript(dump.read_text("utf-8"))
        said.clear()
        assert latest(opened, adopts=True, path=path)
        assert [one for one in said if "are of an earlier version, which did not sign them" in one] == said
        assert len(said) == 1
        assert latest(opened, path=path)
        assert len(said) == 1


def test_an_unsigned_store_that_came_later_is_set_aside(kept, opened, said):
    execute(kept, "DROP TABLE seal")
    assert latest(opened) is None
    assert len(said) == 1


def test_where_it_cannot_be_set_aside_nothing_of_it_is_read(kept, opened, said, monkeypatch, write_small):
    execute(kept, "DELETE FROM finding")

    def refused(*_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(type(kept), "rename", refused)
    with opened() as store:
        assert store.latest() is None
        write_small(store, "key-1")
        assert store.view().packages()
    (line,) = said
    assert line.startswith(f"{str(kept)!r} was changed by something other than roslens of this user: it is not used")
    assert line.endswith("nothing is kept (Permission denied)")


def test_a_past_commit_is_sealed_with_its_run(kept, opened, said):
    from roslens.store.revisions import KeptRevision

    with opened() as store:
        store.mark_revision(KeptRevision(1, "c0ffee", "k", 5))
    os.utime(kept)
    with opened() as store:
        assert [one.commit for one in store.revisions()] == ["c0ffee"]
    execute(kept, "UPDATE revision SET \"commit\" = 'other'")
    assert latest(opened) is None
    assert json.dumps(said).count("changed by something") == 1


def test_an_earlier_state_of_the_store_is_taken(kept, opened, said, write_small):
    earlier = kept.read_bytes()
    with opened() as store:
        write_small(store, "key-3")
    kept.write_bytes(earlier)
    assert latest(opened) == 2
    assert said == []
