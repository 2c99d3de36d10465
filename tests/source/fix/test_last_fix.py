import pytest

from roslens.model.errors import UsageError
from roslens.source.fix.last_fix import keep_last_fix, take_back
from roslens.source.fix.mended_files import MendedFile
from roslens.source.fix.write_files import write_files


@pytest.fixture
def fixed(tmp_path):
    """A workspace with two fixed files, and the place of the record."""
    root, place = tmp_path / "ws", tmp_path / "last-fix.json"
    root.mkdir()
    files = [MendedFile(name, b"one \xff\r\n", b"two\n") for name in ("a.cpp", "b.cpp")]
    for one in files:
        (root / one.path).write_bytes(one.before)
    keep_last_fix(files, place)
    write_files(files, root)
    return root, place


def test_all_is_as_before(fixed):
    root, place = fixed
    assert take_back(place, root) == (("a.cpp", "b.cpp"), ())
    assert (root / "a.cpp").read_bytes() == (root / "b.cpp").read_bytes() == b"one \xff\r\n"
    with pytest.raises(UsageError, match="no fix to undo"):
        take_back(place, root)


def test_what_changed_since_is_left_and_can_be_taken_back_later(fixed):
    root, place = fixed
    (root / "a.cpp").write_bytes(b"three\n")
    done, (fault,) = take_back(place, root)
    assert done == ("b.cpp",)
    assert str(fault.failure).startswith("a.cpp: it changed since the fix and is left as it is")
    assert (root / "a.cpp").read_bytes() == b"three\n"
    (root / "a.cpp").write_bytes(b"two\n")
    assert take_back(place, root) == (("a.cpp",), ())


def test_what_is_gone_is_told(fixed):
    root, place = fixed
    (root / "a.cpp").unlink()
    _, (fault,) = take_back(place, root)
    assert "gone since the fix" in fault.failure.what


def test_a_file_that_was_never_written_is_as_before(fixed):
    root, place = fixed
    (root / "a.cpp").write_bytes(b"one \xff\r\n")
    assert take_back(place, root) == (("a.cpp", "b.cpp"), ())


def test_a_second_round_keeps_what_was_at_first(fixed):
    root, place = fixed
    record = keep_last_fix([MendedFile("a.cpp", b"one \xff\r\n", b"two\n")], place)
    again = [MendedFile("a.cpp", b"two\n", b"three\n")]
    keep_last_fix(again, place, record)
    write_files(again, root)
    assert take_back(place, root) == (("a.cpp",), ())
    assert (root / "a.cpp").read_bytes() == b"one \xff\r\n"


@pytest.mark.parametrize(
    "text",
    [
        b"",
        b"{",
        b'{"schema": "other/1", "files": []}',
        b'{"schema": "roslens-last-fix/1", "files": [{"path": "../x", "before": "", "after": ""}]}',
        b'{"schema": "roslens-last-fix/1", "files": [{"path": "/x", "before": "", "after": ""}]}',
    ],
)
def test_a_record_that_is_none_is_refused(tmp_path, text):
    (tmp_path / "last-fix.json").write_bytes(text)
    with pytest.raises(UsageError, match="the record of the last fix"):
        take_back(tmp_path / "last-fix.json", tmp_path)
