"""Who writes a journal anew without its key is found out, and so is who cuts its end off."""

import json

import pytest

from roslens.store.journals.journal import ANEW, Journal
from roslens.store.journals.journal_entry import read, written
from roslens.store.journals.read_journal import JournalReader, verify
from roslens.store.journals.signing import Signing


@pytest.fixture
def path(tmp_path):
    return tmp_path / "journal.jsonl"


@pytest.fixture
def signing(tmp_path):
    return Signing(b"k" * 32, tmp_path / "user" / "last")


def fill(path, signing, count=4):
    with Journal(path, signing) as journal:
        for number in range(count):
            journal.add("decided", 100.0 + number, entity=f"node:/n{number}")


def lines_of(path):
    return path.read_bytes().splitlines(keepends=True)


def entries_of(path):
    reader = JournalReader(path)
    found = list(reader.entries())
    reader.close()
    return found


def hashed_anew(lines, signing=None):
    """Write entries anew from the first on, as somebody does who wants no hash to tell."""
    before, found = "", []
    for number, line in enumerate(lines):
        entry = read(line.rstrip())
        entry, line = written(number, entry.time, entry.what, entry.fields, before, signing)
        before = entry.hash
        found.append(line)
    return b"".join(found)


def changed(lines):
    entry = json.loads(lines[1])
    _, line = written(1, entry["time"], "decided", {"entity": "node:/other"}, entry["before"])
    return [lines[0], line, *lines[2:]]


FORGERIES = {
    "changed": changed,
    "removed": lambda lines: [*lines[:1], *lines[2:]],
    "inserted": lambda lines: [*lines[:2], lines[0], *lines[2:]],
    "swapped": lambda lines: [lines[1], lines[0], *lines[2:]],
    "as it was": lambda lines: lines,
}


def test_what_was_written_is_signed(path, signing):
    fill(path, signing)
    found = verify(path, signing=signing)
    assert (found.entries, found.signed, found.wrong) == (4, 4, ())
    fill(path, signing, 2)
    assert verify(path, signing=signing).signed == 6
    # A reader without the key still has the hashes.
    assert verify(path).wrong == ()


@pytest.mark.parametrize("forgery", FORGERIES)
@pytest.mark.parametrize("key", [None, b"x" * 32])
def test_a_journal_hashed_anew_without_the_key_is_found(path, signing, tmp_path, forgery, key):
    fill(path, signing)
    other = Signing(key, tmp_path / "elsewhere") if key else None
    path.write_bytes(hashed_anew(FORGERIES[forgery](lines_of(path)), other))
    assert verify(path).wrong == (), "hashes alone do not show it"
    assert verify(path, signing=signing).wrong
    # Nor does it help that entries are added afterwards.
    fill(path, signing, 1)
    assert verify(path, signing=signing).wrong


def test_a_tail_hashed_anew_is_found(path, signing):
    fill(path, signing)
    lines = lines_of(path)
    last = read(lines[2].rstrip())
    _, line = written(3, 103.0, "decided", {"entity": "node:/other"}, last.hash)
    path.write_bytes(b"".join([*lines[:3], line]))
    assert any("entry 3 is not signed" in one for one in verify(path, signing=signing).wrong)


@pytest.mark.parametrize("kept", [0, 1, 3])
def test_a_tail_that_was_cut_off_is_found(path, signing, kept):
    fill(path, signing)
    path.write_bytes(b"".join(lines_of(path)[:kept]))
    assert verify(path).wrong == ()
    (wrong,) = verify(path, signing=signing).wrong
    assert wrong.startswith("entry 3, the last that was signed here, is not there as it was written")
    fill(path, signing, 1)
    anew = entries_of(path)[kept]
    assert (anew.what, anew.fields["entries"]) == (ANEW, 4)
    assert bool(verify(path, signing=signing).wrong) == (kept > 0)


def test_a_journal_that_was_put_away_is_named_by_the_one_after_it(path, signing):
    fill(path, signing)
    head = verify(path).head
    path.rename(path.with_name("old.jsonl"))
    fill(path, signing, 1)
    assert [one.fields.get("head", "") for one in entries_of(path)] == [head, ""]
    assert verify(path, signing=signing).wrong == ()
    assert verify(path.with_name("old.jsonl"), signing=Signing(signing.key, path.with_name("none"))).signed == 4


def test_a_journal_of_an_earlier_version_is_gone_on_with(path, signing):
    fill(path, None)
    found = verify(path, signing=signing)
    assert (found.entries, found.signed, found.wrong) == (4, 0, ())
    fill(path, signing, 2)
    found = verify(path, signing=signing)
    assert (found.entries, found.signed, found.wrong) == (6, 2, ())
    # From the first that is signed on, what came before it cannot be changed either.
    path.write_bytes(hashed_anew(changed(lines_of(path))))
    assert verify(path, signing=signing).wrong


def test_a_torn_line_is_no_forgery(path, signing):
    fill(path, signing)
    with path.open("ab") as file:
        file.write(b'{"before":"x')
    fill(path, signing, 1)
    found = verify(path, signing=signing)
    assert (found.entries, found.signed, found.wrong) == (6, 6, ())
