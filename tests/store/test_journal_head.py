"""Where a journal ends is told each second, with whether that is what was signed."""

import pytest

from roslens.store.journals.journal import Journal
from roslens.store.journals.journal_entry import read, written
from roslens.store.journals.journal_head import journal_head
from roslens.store.journals.read_journal import verify
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


def test_without_a_journal_there_is_none(path, signing):
    assert journal_head(path, signing) is None


def test_it_is_the_one_that_verifying_wants(path, signing):
    fill(path, signing)
    head = journal_head(path, signing)
    assert (head.path, head.entries, head.wrong) == (str(path), 4, "")
    fill(path, signing, 2)
    assert verify(path, head.hash, signing).wrong == ()
    assert journal_head(path, signing).entries == 6


@pytest.mark.parametrize("kept", [0, 1, 3])
def test_an_end_that_was_cut_off_shows(path, signing, kept):
    fill(path, signing)
    before = journal_head(path, signing)
    path.write_bytes(b"".join(path.read_bytes().splitlines(keepends=True)[:kept]))
    head = journal_head(path, signing)
    assert head.entries == kept < before.entries
    assert head.wrong == f"entry 3 ({before.hash[:16]}…), the last that was signed, is not there: the end was cut off"


def test_so_does_a_journal_that_is_gone(path, signing):
    fill(path, signing)
    path.unlink()
    assert journal_head(path, signing).wrong == "it is not there"


def test_so_does_an_entry_of_somebody_without_the_key(path, signing):
    fill(path, signing)
    last = read(path.read_bytes().splitlines()[-1])
    _, line = written(4, 104.0, "decided", {}, last.hash)
    with path.open("ab") as stream:
        stream.write(line)
    assert journal_head(path, signing).wrong == "entry 4 is not signed with the key of this journal"
    path.write_bytes(b"no entry\n")
    assert "is not an entry" in journal_head(path, signing).wrong


def test_one_with_the_key_of_a_copy_that_went_another_way(path, signing, tmp_path):
    """Who has the key, but not what is kept outside, writes the last entry anew."""
    fill(path, signing)
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join(lines[:3]))
    with Journal(path, Signing(signing.key, tmp_path / "elsewhere")) as journal:
        journal.add("decided", 103.0, entity="node:/other")
    assert journal_head(path, signing).wrong.startswith("entry 3 is not the one that was signed last")


def test_what_is_not_complete_is_not_there_yet(path, signing):
    fill(path, signing)
    before = journal_head(path, signing)
    with path.open("ab") as stream:
        stream.write(b'{"before":"')
    assert journal_head(path, signing) == before


def test_a_journal_without_a_key_has_a_head(path, signing):
    fill(path, None)
    head = journal_head(path, signing)
    assert (head.entries, head.wrong) == (4, "")
