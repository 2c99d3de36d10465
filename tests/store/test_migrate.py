"""Migrations: in order, each once, all or nothing; every schema there ever was can still be read."""

import sqlite3
from contextlib import closing
from pathlib import Path

import msgspec
import pytest

from roslens.model.errors import StoreError
from roslens.model.finding import Severity
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.store.migrate import APPLICATION_ID, SCHEMA, migrate
from roslens.store.runs import Store

OLD_STORES = sorted((Path(__file__).parents[1] / "fixtures" / "store").glob("schema_*.sql"))


@pytest.fixture
def schema(tmp_path):
    folder = tmp_path / "schema"
    folder.mkdir()
    (folder / "0001_first.sql").write_text("-- a ; in a comment\nCREATE TABLE a (x);\nINSERT INTO a VALUES ('1;2');\n")
    (folder / "0002_second.sql").write_text("CREATE TABLE b (y);\nINSERT INTO b SELECT x FROM a;\n")
    return folder


@pytest.fixture
def connection(tmp_path):
    with closing(sqlite3.connect(tmp_path / "store.sqlite", isolation_level=None)) as connection:
        yield connection


def version_of(connection):
    return connection.execute("PRAGMA user_version").fetchone()[0]


def test_a_new_file_gets_all_steps(connection, schema):
    migrate(connection, Path("store.sqlite"), schema)
    assert version_of(connection) == 2
    assert connection.execute("PRAGMA application_id").fetchone() == (APPLICATION_ID,)
    assert connection.execute("PRAGMA journal_mode").fetchone() == ("wal",)
    assert connection.execute("PRAGMA auto_vacuum").fetchone() == (2,)
    assert connection.execute("SELECT y FROM b").fetchall() == [("1;2",)]


def test_an_older_file_gets_what_it_lacks(connection, schema):
    second = schema / "0002_second.sql"
    later = second.read_text()
    second.unlink()
    migrate(connection, None, schema)
    connection.execute("INSERT INTO a VALUES ('mine')")
    second.write_text(later)
    migrate(connection, None, schema)
    assert version_of(connection) == 2
    assert connection.execute("SELECT y FROM b ORDER BY y").fetchall() == [("1;2",), ("mine",)]
    migrate(connection, None, schema)
    assert connection.execute("SELECT count(*) FROM b").fetchone() == (2,)


def test_a_step_that_fails_changes_nothing(connection, schema):
    (schema / "0003_third.sql").write_text("CREATE TABLE c (z);\nINSERT INTO nowhere VALUES (1);\n")
    with pytest.raises(sqlite3.OperationalError, match="nowhere"):
        migrate(connection, None, schema)
    assert version_of(connection) == 2
    assert connection.execute("SELECT name FROM sqlite_master ORDER BY name").fetchall() == [("a",), ("b",)]


def test_a_newer_file_is_refused(connection, schema):
    migrate(connection, None, schema)
    (schema / "0002_second.sql").unlink()
    with pytest.raises(StoreError) as caught:
        migrate(connection, Path("store.sqlite"), schema)
    assert str(caught.value) == (
        "store.sqlite: the store was written by a newer roslens (schema 2); expected schema 1 or older. "
        "Upgrade roslens, or move the file away; `roslens check` makes a new one"
    )
    assert version_of(connection) == 2


def test_the_steps_are_numbered_without_a_gap():
    numbers = [int(file.name[:4]) for file in sorted(SCHEMA.glob("*.sql"))]
    assert numbers == list(range(1, len(numbers) + 1))


def test_there_is_an_old_store_for_every_schema():
    assert [int(file.stem[-4:]) for file in OLD_STORES] == [int(file.name[:4]) for file in sorted(SCHEMA.glob("*.sql"))]


@pytest.mark.parametrize("dump", OLD_STORES, ids=lambda file: file.stem)
def test_old_stores_can_be_read_and_written(tmp_path, dump, sample, write_small):
    path = tmp_path / "store.sqlite"
    with closing(sqlite3.connect(path)) as connection:
        connection.executescript(dump.read_text("utf-8"))
    with Store.open(path) as store:
        view = store.view()
        reported = [one.packages for one in view.header.repositories]
        assert reported == ([("arm", "drive")] if dump.stem >= "schema_0007" else [])
        left_out = view.header.graphs.left_out if view.header.graphs else ()
        assert left_out == (("drive/launch/other.launch.xml",) if dump.stem >= "schema_0010" else ())
        assert msgspec.structs.replace(view.header, repositories=(), graphs=None) == sample.header()
        assert [package.name for package in view.packages()] == ["arm", "drive"]
        assert [finding.severity for finding in view.findings()] == [Severity.WARNING, Severity.NOTE, Severity.ERROR]
        worst = list(view.findings())[-1] if dump.stem >= "schema_0011" else None
        assert worst is None or worst.weight == (Consequence.WRONG, Certainty.PROVEN)
        entities = [msgspec.structs.replace(one, values={**one.values}) for one in view.package("drive").entities]
        for one in entities:
            one.values.pop("revisions", None)
        assert entities[1:] == list(sample.drive().entities[1:])
        assert view.workspace.package_values == sample.workspace().package_values
        kept = [(one.name, one.configuration.nodes[0].name) for one in view.configurations()]
        assert kept == ([("robot", "/drive")] if dump.stem >= "schema_0002" else [])
        aside = [(one.state.value, one.finding.path) for one in view.set_aside()]
        assert aside == ([("suppressed", "src/drive/src/drive.cpp")] if dump.stem >= "schema_0005" else [])
        process = [(one.head, one.files) for one in view.process]
        reported = ("c0ffee", {"src/drive/src/drive.cpp": {"revisions": 3.0}})
        assert process == ([reported] if dump.stem >= "schema_0006" else [])
        commits = [one.commits for one in store.revisions()]
        assert commits == ([(("arm", "c0ffee"), ("drive", ""))] if dump.stem >= "schema_0009" else [])
        assert store.view(write_small(store, "key-2")).packages() == view.packages()


@pytest.mark.parametrize("ended", [True, False])
def test_a_disk_that_fails_is_told_whether_sqlite_has_ended_the_transaction_or_not(
    connection, schema, monkeypatch, ended
):
    def failing(connection, _path, _newest):
        if ended:
            connection.execute("ROLLBACK")
        raise sqlite3.OperationalError("disk I/O error")

    monkeypatch.setattr("roslens.store.migrate._checked_version", failing)
    with pytest.raises(sqlite3.OperationalError, match="disk I/O error"):
        migrate(connection, Path("store.sqlite"), schema)
    assert not connection.in_transaction
