"""What only a shared store has: other machines, a server that goes away, an address that is wrong."""

import json
import subprocess
import sys

import pytest

from roslens.cli.main import main
from roslens.model.errors import StoreError, UsageError
from roslens.model.result import RunHeader
from roslens.store.postgres.connection import divided, shown
from roslens.store.postgres.dialect import translated
from roslens.store.runs import Store

MANIFEST = (
    '<package format="3"><name>p</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>\n'
)


def test_an_address_and_its_schema():
    assert divided("postgresql://me:secret@h/d?schema=nav2&sslmode=require") == (
        "postgresql://me:secret@h/d?sslmode=require",
        "nav2",
    )
    assert divided("postgresql://h/d") == ("postgresql://h/d", "roslens")
    assert shown("postgresql://me:secret@h/d") == "postgresql://me@h/d"
    with pytest.raises(UsageError, match="letters, digits"):
        divided('postgresql://h/d?schema=a";drop')


def test_statements_are_translated():
    assert translated("SELECT 1 WHERE a = ? AND b LIKE 'x%'") == "SELECT 1 WHERE a = %s AND b LIKE 'x%%'"
    assert translated("INSERT INTO unit (key) VALUES (?)") == "INSERT INTO unit (key) VALUES (%s) RETURNING id"
    assert translated("SELECT max(id) FROM run") == "SELECT max(id) FROM run"


def test_a_server_that_is_not_there(tmp_path):
    pytest.importorskip("psycopg")
    with pytest.raises(StoreError, match="does not let in"):
        Store.open_shared(f"postgresql://nobody@/x?host={tmp_path}", wait_s=1)


HOLD = """
import sys
from roslens.model.result import RunHeader
from roslens.store.runs import Store
with Store.open_shared(sys.argv[1]) as store, store.writing(RunHeader("other", "/")):
    print("begun", flush=True)
    sys.stdin.read()
"""


@pytest.mark.real
def test_a_shared_store_is_not_sealed(server, write_small):
    with Store.open_shared(server.schema("not_sealed")) as store:
        write_small(store, "key-1")
        store._connection.execute("UPDATE finding SET message = 'other'")
        assert {one.message for one in store.view().findings()} == {"other"}


@pytest.mark.real
def test_another_process_writes(server, write_small):
    address = server.schema("two_writers")
    with (
        Store.open_shared(address, wait_s=0.2) as store,
        subprocess.Popen(
            [sys.executable, "-c", HOLD, address], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        ) as other,
    ):
        try:
            assert other.stdout.readline() == "begun\n"
            with pytest.raises(StoreError, match=rf"another run is writing to the store \(process {other.pid} on "):
                write_small(store)
            with pytest.raises(StoreError, match=rf"the first one is being made \(process {other.pid} on "):
                store.view()
            reported = []
            with pytest.raises(StoreError, match="another run"), store.writing(RunHeader("mine", "/"), reported.append):
                pass
            assert [one.partition(" on ")[0] for one in reported] == [f"process {other.pid}"]
        finally:
            other.kill()
    # One that was killed holds nothing.
    with Store.open_shared(address) as store:
        assert store.latest() is None
        write_small(store)


@pytest.mark.real
def test_the_server_goes_away_while_a_run_is_written(server, sample, write_small):
    address = server.schema("gone")
    with Store.open_shared(address) as store:
        first = write_small(store)
        with store.writing(sample.header("key-2")) as writer:
            writer.add("unit-other", sample.drive())
            server.throw_out()
            with pytest.raises(StoreError, match=r"the shared store cannot be used.*Run the same command again"):
                writer.complete(sample.workspace(), sample.header("key-2"))
    with Store.open_shared(address) as store:
        assert store.latest() == first
        assert not store.has_unit("unit-other")
        assert write_small(store, "key-2") > first


@pytest.mark.real
def test_a_newer_store_is_refused(server):
    address = server.schema("newer")
    with Store.open_shared(address) as store:
        store._connection.execute("INSERT INTO schema_version (number) VALUES (?)", (999,))
    with pytest.raises(StoreError, match="a newer roslens"):
        Store.open_shared(address)


@pytest.fixture
def workspace(tmp_path, server, monkeypatch):
    (tmp_path / "ws" / "p").mkdir(parents=True)
    (tmp_path / "ws" / "p" / "package.xml").write_text(MANIFEST)
    (tmp_path / "ws" / "p" / "a.cpp").write_text("int f(int x) { if (x) { return 1; } return 0; }\n")
    (tmp_path / "ws" / "roslens.toml").write_text(f'store = "{server.schema("cli")}"\n')
    monkeypatch.chdir(tmp_path / "ws")
    return tmp_path / "ws"


def check(*words):
    return main(["check", "-q", "--jobs", "1", "--no-graph", "--fail-on", "never", *words])


@pytest.mark.real
def test_a_workspace_that_is_kept_in_a_database(workspace, capsys):
    # A configuration that came with a clone sends nothing anywhere before the user said so.
    assert check() == 0
    assert "is not used until `roslens trust`" in capsys.readouterr().err
    assert (workspace / ".roslens/store.sqlite").exists()
    (workspace / ".roslens/store.sqlite").unlink()
    assert main(["trust", "."]) == 0
    assert check("--format", "json", "-o", "a.json") == 0
    assert not (workspace / ".roslens/store.sqlite").exists()
    capsys.readouterr()
    assert main(["report", "-o", "pages"]) == 0, capsys.readouterr().err
    assert (workspace / "pages/index.html").exists()
    assert check("--no-store", "--format", "json", "-o", "b.json") == 0
    shared, local = (json.loads((workspace / name).read_text()) for name in ("a.json", "b.json"))
    del shared["run"], local["run"]
    assert shared == local
