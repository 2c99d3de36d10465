import json
import os
import resource
import stat
from concurrent.futures import ThreadPoolExecutor

import pytest

from roslens.model.errors import StoreError
from roslens.store.journals.journal import Journal
from roslens.store.journals.journal_entry import MOST_BYTES
from roslens.store.journals.read_journal import JournalReader, verify


@pytest.fixture
def path(tmp_path):
    return tmp_path / "state" / "journal.jsonl"


def fill(path, count=3):
    with Journal(path) as journal:
        for number in range(count):
            journal.add("decided", 100.0 + number, entity=f"node:/n{number}")


def test_entries_follow_each_other_and_can_be_read_again(path):
    fill(path)
    reader = JournalReader(path)
    found = list(reader.entries())
    assert [(one.n, one.time, one.fields) for one in found] == [
        (0, 100.0, {"entity": "node:/n0"}),
        (1, 101.0, {"entity": "node:/n1"}),
        (2, 102.0, {"entity": "node:/n2"}),
    ]
    assert [one.before for one in found] == ["", found[0].hash, found[1].hash]
    fill(path, 1)
    assert [one.n for one in reader.entries()] == [3], "what came since"
    reader.close()
    assert verify(path).entries == 4
    assert not verify(path).wrong


def test_it_is_for_its_user_alone(path):
    fill(path)
    assert stat.S_IMODE(path.stat().st_mode) == 0o600
    assert stat.S_IMODE(path.parent.stat().st_mode) == 0o700


@pytest.mark.parametrize("line", [0, 1, 2])
def test_a_changed_entry_shows(path, line):
    fill(path)
    lines = path.read_bytes().splitlines(keepends=True)
    lines[line] = lines[line].replace(b"/n", b"/m")
    path.write_bytes(b"".join(lines))
    assert verify(path).wrong
    assert verify(path).entries == line


@pytest.mark.parametrize("line", [0, 1])
def test_an_entry_that_was_taken_out_shows(path, line):
    fill(path)
    lines = path.read_bytes().splitlines(keepends=True)
    del lines[line]
    path.write_bytes(b"".join(lines))
    (wrong,) = verify(path).wrong
    assert f"line {line + 1}" in wrong


def test_an_end_that_was_cut_off_shows_against_a_hash_that_was_kept(path):
    fill(path)
    head = verify(path).head
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join(lines[:-1]))
    assert not verify(path).wrong
    assert "cut off" in verify(path, head).wrong[0]
    assert not verify(path, json.loads(lines[1])["hash"]).wrong


def test_a_line_that_was_never_completed_is_told_and_writing_goes_on(path):
    fill(path)
    whole = path.read_bytes()
    path.write_bytes(whole[:-30])
    assert "not complete" in verify(path).wrong[0]
    fill(path, 1)
    assert not verify(path).wrong
    reader = JournalReader(path)
    assert [one.what for one in reader.entries()] == ["decided", "decided", "torn", "decided"]
    reader.close()


def test_what_is_no_journal_is_not_appended_to(path):
    path.parent.mkdir()
    path.write_text("name: rover\nparts: 3\n")
    with pytest.raises(StoreError, match="not an entry"):
        Journal(path)
    assert path.read_text() == "name: rover\nparts: 3\n"


def test_a_long_entry_is_shortened_and_still_one_line(path):
    with Journal(path) as journal:
        entry = journal.add("outcome", 1.0, text="x" * 1_000_000, many=list(range(100_000)))
    assert path.stat().st_size <= MOST_BYTES
    assert "shortened" in entry.fields["text"]
    assert not verify(path).wrong


def test_several_writers_do_not_fork_it(path):
    def write(number):
        with Journal(path) as journal:
            for _ in range(20):
                journal.add("note", float(number))

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(write, range(4)))
    assert verify(path).entries == 80
    assert not verify(path).wrong


def test_several_threads_may_share_it(path):
    with Journal(path) as journal, ThreadPoolExecutor(4) as pool:
        list(pool.map(lambda number: journal.add("note", float(number)), range(80)))
    assert verify(path).entries == 80
    assert not verify(path).wrong


def test_what_does_not_fit_on_the_disk_is_refused_and_leaves_a_whole_journal(path):
    fill(path)
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    import signal

    ignored = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    try:
        with Journal(path) as journal:
            resource.setrlimit(resource.RLIMIT_FSIZE, (path.stat().st_size + 50, before[1]))
            with pytest.raises(StoreError, match="cannot write the journal"):
                journal.add("announced", 5.0, text="y" * 200)
            resource.setrlimit(resource.RLIMIT_FSIZE, before)
            journal.add("announced", 6.0)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, ignored)
    assert verify(path).entries == 4
    assert not verify(path).wrong


def test_a_folder_in_its_place_is_named(tmp_path):
    with pytest.raises(StoreError, match="--journal"):
        Journal(tmp_path)
    with pytest.raises(StoreError, match="cannot read"):
        verify(tmp_path / "none")


def test_a_file_without_lines_is_not_kept_whole(path):
    path.parent.mkdir()
    with path.open("wb") as file:
        os.truncate(file.fileno(), 5 * MOST_BYTES)
    assert verify(path).wrong
