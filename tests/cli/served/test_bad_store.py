"""`roslens serve` where the store is missing, newer, somebody else's or held by who writes."""

from __future__ import annotations

import os
import sqlite3
import time
from contextlib import closing
from pathlib import Path

import pytest
from dashboard.journal.test_journal_pages import Client

from roslens.cli.main import main
from roslens.cli.workplace.own_results import key_of_store
from roslens.cli.workplace.workplace import CACHE, STORE, open_store
from roslens.dashboard.server import create_app
from roslens.dashboard.site import Site
from roslens.store.runs import Store
from roslens.store.sealing.seals import seal_all

Said = pytest.CaptureFixture[str]


@pytest.fixture
def checked(tmp_path: Path, capsys: Said) -> Path:
    """A workspace of one package that was checked."""
    package = tmp_path / "ws" / "tiny"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="3"><name>tiny</name><version>1.0.0</version><description>d</description>'
        "<maintainer email='a@b.c'>a</maintainer><license>MIT</license></package>\n"
    )
    main(["check", str(tmp_path / "ws"), "--quiet"])
    capsys.readouterr()
    return tmp_path / "ws"


def test_a_workspace_that_was_never_checked_is_said(tmp_path: Path, capsys: Said) -> None:
    assert main(["serve", str(tmp_path), "--port", "0"]) == 2
    assert "roslens check" in capsys.readouterr().err
    assert not (tmp_path / ".roslens").exists()


def test_a_store_of_a_newer_roslens_is_said_and_left_as_it_is(checked: Path, capsys: Said) -> None:
    store = checked / ".roslens" / STORE
    with closing(sqlite3.connect(store)) as connection, connection:
        connection.execute("PRAGMA user_version = 999")
        seal_all(connection, key_of_store(store, os.environ))
    assert main(["serve", str(checked), "--port", "0"]) == 2
    said = capsys.readouterr().err
    assert "written by a newer roslens (schema 999)" in said
    assert "Upgrade roslens" in said
    with closing(sqlite3.connect(store)) as connection, connection:
        assert connection.execute("PRAGMA user_version").fetchone() == (999,)


def test_a_store_of_another_program_is_said(checked: Path, capsys: Said) -> None:
    store = checked / ".roslens" / STORE
    store.write_bytes(b"this is no database, whoever wrote it" * 100)
    assert main(["serve", str(checked), "--port", "0"]) == 2
    assert str(store) in capsys.readouterr().err


def test_who_writes_keeps_nobody_from_reading(checked: Path) -> None:
    writer = sqlite3.connect(checked / ".roslens" / STORE, isolation_level=None)
    writer.execute("BEGIN IMMEDIATE")
    try:
        with open_store(str(checked)) as store:
            assert [one.name for one in store.view(None).packages()] == ["tiny"]
    finally:
        writer.execute("ROLLBACK")
        writer.close()


def test_a_cache_that_is_gone_is_not_missed(checked: Path) -> None:
    (checked / ".roslens" / CACHE).unlink(missing_ok=True)
    with open_store(str(checked)) as store:
        assert store.view(None).packages()


PAGES = (
    "/", "/packages", "/packages/tiny", "/findings", "/graph", "/metrics", "/rules", "/failures", "/search?q=tiny",
    "/hotspots", "/packages.csv", "/findings.json",
)  # fmt: skip


def test_a_store_that_is_held_alone_is_said_on_every_page_and_soon(checked: Path) -> None:
    store = checked / ".roslens" / STORE
    with closing(sqlite3.connect(store)) as connection, connection:
        # A write-ahead log lets nobody keep readers out; without one, as on a network, a writer does.
        assert connection.execute("PRAGMA journal_mode = DELETE").fetchone() == ("delete",)
    with open_store(str(checked)) as opened:
        view = opened.view(None)
        view.wait_at_most(0.05)
        client = Client(create_app(Site(view, quantities={one.key: one for one in view.quantities()})))
        holder = sqlite3.connect(store, isolation_level=None)
        holder.execute("BEGIN EXCLUSIVE")
        begun = time.monotonic()
        for path in PAGES:
            found = client.get(path)
            assert found.status_code == 503, path
            assert "the store is in use by another process" in found.text, path
            assert "Wait until it is finished" in found.text, path
        assert time.monotonic() - begun < 2 * len(PAGES)
        holder.execute("ROLLBACK")
        holder.close()
        assert [client.get(path).status_code for path in PAGES[:4]] == [200] * 4


def test_who_holds_the_store_from_the_start_is_said(
    checked: Path, capsys: Said, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(Store.open.__func__.__kwdefaults__, "wait_s", 0.05)
    holder = sqlite3.connect(checked / ".roslens" / STORE, isolation_level=None)
    holder.execute("PRAGMA locking_mode = EXCLUSIVE")
    holder.execute("BEGIN EXCLUSIVE")
    assert main(["serve", str(checked), "--port", "0"]) == 2
    assert "the store is in use by another process" in capsys.readouterr().err
    holder.close()
