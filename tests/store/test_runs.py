"""Runs: written as a whole or not at all, shared where nothing changed, removed with what only they hold."""

import sqlite3
from contextlib import closing

import pytest

from roslens.model.errors import StoreError
from roslens.model.finding import Finding, Severity
from roslens.model.result import WorkspaceResult
from roslens.store.runs import Store


@pytest.fixture
def path(tmp_path):
    return tmp_path / ".roslens" / "store.sqlite"


def test_a_new_store_is_empty_and_its_folder_marked(path):
    with Store.open(path) as store:
        assert store.latest() is None
        assert store.run_with("key-1") is None
        assert store.runs() == ()
        with pytest.raises(StoreError, match=r"no run was completed yet\. Run `roslens check` first"):
            store.view()
    assert (path.parent / ".gitignore").read_text() == "*\n"
    assert (path.parent / "CACHEDIR.TAG").read_text().startswith("Signature: 8a477f597d28d172789f06886806bc55\n")


def test_a_folder_of_another_name_gets_the_store_only(tmp_path):
    Store.open(tmp_path / "kept" / "runs.sqlite").close()
    assert [file.name for file in (tmp_path / "kept").iterdir()] == ["runs.sqlite"]


def test_a_run_is_seen_when_it_is_complete(path, sample, write_small):
    with Store.open(path) as store:
        number = write_small(store)
        assert store.latest() == store.run_with("key-1") == number
        assert store.has_unit("unit-drive")
    with Store.open(path) as store:
        (run,) = store.runs()
        assert run.id == number
        assert run.header == sample.header()
        assert (run.packages, run.files, run.entities, run.findings, run.failures) == (2, 4, 5, 3, 2)
        assert store.view().header == sample.header()


def fail_while_writing(store, sample):
    with store.writing(sample.header()) as writer:
        writer.add("unit-drive", sample.drive())
        _ = 1 / 0


def test_leaving_without_complete_discards(path, sample):
    with Store.open(path) as store:
        with store.writing(sample.header()) as writer:
            writer.add("unit-drive", sample.drive())
            assert store.has_unit("unit-drive")
            assert store.latest() is None
        assert not store.has_unit("unit-drive")
        with pytest.raises(ZeroDivisionError):
            fail_while_writing(store, sample)
        assert not store.has_unit("unit-drive")
        assert store.runs() == ()


def test_units_are_shared(path, sample, write_small):
    with Store.open(path) as store:
        first = write_small(store)
        header = sample.header("key-2", "2024-05-02T10:00:00+00:00")
        with store.writing(header) as writer:
            writer.reuse("unit-drive")
            writer.add("unit-arm", sample.arm())
            second = writer.complete(sample.workspace(), header)
        assert second > first
        assert store.run_with("key-1") == first
        assert store.run_with("key-2") == store.latest() == second
        assert store._connection.execute("SELECT count(*) FROM unit WHERE key IS NOT NULL").fetchone() == (2,)
        assert store._connection.execute("SELECT count(*) FROM vocabulary").fetchone() == (1,)
        old, new = store.view(first), store.view(second)
        assert old.packages() == new.packages()
        assert list(old.findings()) == list(new.findings())
        assert [run.id for run in store.runs()] == [second, first]


def test_the_newest_run_of_a_key_counts(path, write_small):
    with Store.open(path) as store:
        first, second = write_small(store), write_small(store)
        assert first != second
        assert store.run_with("key-1") == second


def test_a_unit_that_is_gone_cannot_be_used_again(path, sample):
    with (
        Store.open(path) as store,
        store.writing(sample.header()) as writer,
        pytest.raises(StoreError, match=r"'unit-drive' is no longer in the store.*Run the same command again"),
    ):
        writer.reuse("unit-drive")


def test_units_can_be_read_by_key(path, sample, write_small):
    with Store.open(path) as store:
        write_small(store)
        assert store.unit("unit-drive") == sample.drive()
        assert store.unit_summary("unit-arm").name == "arm"
        assert store.unit("no such") is None
        assert store.unit_summary("no such") is None


def test_a_finding_keeps_its_witnesses_and_the_others(path, sample):
    reported = Finding(
        "cpp.explicit", Severity.WARNING, "m", "a.cpp", 3, witnesses=("cpplint.runtime/explicit",), others=("a.cpp:9",)
    )
    arm = sample.arm()
    result = type(arm)(arm.package, arm.files, arm.entities, (reported,), ())
    with Store.open(path) as store:
        with store.writing(sample.header()) as writer:
            writer.add("unit-arm", result)
            writer.complete(WorkspaceResult(), sample.header())
        assert list(store.view().findings()) == [reported]
        assert store.unit("unit-arm").findings == (reported,)


def test_prune_keeps_the_newest_and_what_they_share(path, sample, write_small):
    with Store.open(path) as store:
        write_small(store)
        header = sample.header("key-2")
        with store.writing(header) as writer:
            writer.reuse("unit-drive")
            last = writer.complete(WorkspaceResult(), header)
        assert store.prune(1) == 1
        assert [run.id for run in store.runs()] == [last]
        assert store.has_unit("unit-drive")
        assert not store.has_unit("unit-arm")
        for table in ("file", "entity", "measured", "finding", "failure"):
            units = {row[0] for row in store._connection.execute(f"SELECT unit FROM {table}")}
            assert len(units) == 1, table
        assert store.prune(5) == 0
        with pytest.raises(StoreError, match=rf"there is no run 1; expected one of {last}"):
            store.view(1)


def write_large(store, sample, packages):
    header = sample.header("key-large")
    with store.writing(header) as writer:
        for key, result in sample.large(packages):
            writer.add(key, result)
        writer.complete(WorkspaceResult(), header)


def test_prune_makes_the_file_smaller(path, sample, write_small):
    with Store.open(path) as store:
        write_large(store, sample, 10)
        write_small(store)
    before = path.stat().st_size
    with Store.open(path) as store:
        store.prune(1)
    assert path.stat().st_size < before / 2


def test_in_memory_nothing_is_written(tmp_path, monkeypatch, write_small):
    monkeypatch.chdir(tmp_path)
    with Store.open(None) as store:
        assert store.view(write_small(store)).packages()
    assert list(tmp_path.iterdir()) == []


def test_a_store_that_cannot_be_changed_can_be_read(path, write_small, monkeypatch):
    with Store.open(path) as store:
        write_small(store)
    monkeypatch.setattr("os.access", lambda path, mode: False)
    with Store.open(path) as store:
        assert len(store.view().packages()) == 2
        with pytest.raises(StoreError, match=r"cannot be written.*run with --no-store"):
            write_small(store)


def test_a_file_that_is_no_database_is_left_alone(path):
    path.parent.mkdir()
    path.write_text("notes of mine\n" * 100)
    with pytest.raises(StoreError, match=r"store\.sqlite: the file is not a SQLite database.*Move the file away"):
        Store.open(path)
    assert path.read_text().startswith("notes of mine")


def test_the_database_of_another_program_is_left_alone(path):
    path.parent.mkdir()
    with closing(sqlite3.connect(path)) as other:
        other.execute("CREATE TABLE notes (text)")
    with pytest.raises(StoreError, match="made by another program"):
        Store.open(path)
    with closing(sqlite3.connect(path)) as other:
        assert other.execute("SELECT name FROM sqlite_master").fetchall() == [("notes",)]
        assert other.execute("PRAGMA user_version").fetchone() == (0,)
        assert other.execute("PRAGMA journal_mode").fetchone() == ("delete",)


def test_a_damaged_store_says_so(path, sample):
    with Store.open(path) as store:
        write_large(store, sample, 4)
    content = bytearray(path.read_bytes())
    content[8192:] = b"\x5a" * (len(content) - 8192)
    path.write_bytes(content)
    with pytest.raises(StoreError, match=r"the store is damaged.*Move the file away"), Store.open(path) as store:
        list(store.view().findings())


@pytest.mark.parametrize("name", ["a folder", "a file as folder"])
def test_a_place_where_no_store_can_be(tmp_path, name):
    blocked = tmp_path / "blocked"
    if name == "a folder":
        (blocked / "store.sqlite").mkdir(parents=True)
    else:
        blocked.write_text("")
    with pytest.raises(StoreError, match=r"store\.sqlite: the store cannot be .*run with --no-store"):
        Store.open(blocked / "store.sqlite")


def test_a_full_disk_leaves_the_run_before(path, sample, write_small):
    with Store.open(path) as store:
        number = write_small(store)
        pages = store._connection.execute("PRAGMA page_count").fetchone()[0]
        store._connection.execute(f"PRAGMA max_page_count = {pages + 20}")
        with pytest.raises(StoreError, match=r"the disk is full.*--no-store; earlier runs are still there"):
            write_large(store, sample, 20)
        assert store.latest() == number
        assert not store.has_unit("key-package_0000")
    with Store.open(path) as store:
        assert store.latest() == number
        assert len(store.view().packages()) == 2


def test_a_writer_that_was_rolled_back_takes_nothing_more(path, sample):
    with Store.open(path) as store, store.writing(sample.header()) as writer:
        writer.add("unit-drive", sample.drive())
        # What SQLite itself does on some errors, a full disk among them.
        store._connection.execute("ROLLBACK")
        for act in (
            lambda: writer.add("unit-arm", sample.arm()),
            lambda: writer.reuse("unit-drive"),
            lambda: writer.complete(sample.workspace(), sample.header()),
        ):
            with pytest.raises(StoreError, match="was discarded after an error"):
                act()
        assert store.latest() is None


def test_texts_that_utf8_cannot_write(path, sample):
    odd = Finding("style.name", Severity.NOTE, "bad \udcff name \ud800", "src/\udce4.cpp", fingerprint="a")
    arm = sample.arm()
    result = type(arm)(arm.package, arm.files, arm.entities, (odd,), ())
    with Store.open(path) as store:
        header = sample.header()
        with store.writing(header) as writer:
            writer.add("unit-arm", result)
            writer.complete(WorkspaceResult(findings=(odd,)), header)
        mine, of_workspace = store.view().findings()
        assert mine.path == "src/\\xe4.cpp"
        assert mine.message == "bad \\xff name \\ud800"
        assert of_workspace == mine
        assert [count.example for count in store.view().packages()[0].rules] == [
            "src/\\xe4.cpp: bad \\xff name \\ud800"
        ]


def test_numbers_that_json_cannot_write(path, sample):
    huge, beyond = 2**70, 10**400
    arm = sample.arm()
    values = {
        "loc": 0,
        "static_paths": huge,
        "other": beyond,
        "less": -beyond,
        "none": float("nan"),
        "exact": 2**53,
    }
    package = type(arm.entities[0])("package:arm", arm.entities[0].kind, "arm", "src/arm", values=values)
    finding = Finding("a.b", Severity.NOTE, "m", value=beyond, bound=float("inf"))
    with Store.open(path) as store:
        header = sample.header()
        with store.writing(header) as writer:
            writer.add("unit-arm", type(arm)(arm.package, arm.files, (package,), (finding,)))
            shared = {"dependents": 10**30, "tier": float("inf")}
            writer.complete(WorkspaceResult(package_values={"arm": shared}), header)
        view = store.view()
        largest = 1.7976931348623157e308
        kept = {"loc": 0, "static_paths": float(huge), "exact": 2**53, "dependents": 1e30}
        summary = view.packages()[0]
        assert summary.values == {**kept, "other": largest, "less": -largest}
        assert view.entity("package:arm").values == {**kept, "other": beyond, "less": -beyond}
        (found,) = view.findings()
        assert (found.value, found.bound) == (largest, float("inf"))
