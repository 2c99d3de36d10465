import stat

from roslens.source.fix.mended_files import MendedFile
from roslens.source.fix.write_files import write_files


def file(root, name="a.cpp", before=b"one\n", after=b"two\n", mode=0o644):
    (root / name).write_bytes(before)
    (root / name).chmod(mode)
    return MendedFile(name, before, after)


def test_content_changes_and_the_mode_stays(tmp_path):
    one = file(tmp_path, mode=0o755)
    assert write_files([one], tmp_path) == ((one,), ())
    assert (tmp_path / "a.cpp").read_bytes() == b"two\n"
    assert stat.S_IMODE((tmp_path / "a.cpp").stat().st_mode) == 0o755
    assert [one.name for one in tmp_path.iterdir()] == ["a.cpp"]


def test_a_read_only_file_is_a_failure_and_the_others_stand(tmp_path):
    locked, open_ = file(tmp_path, mode=0o444), file(tmp_path, "b.cpp")
    written, faults = write_files([locked, open_], tmp_path)
    assert written == (open_,)
    (fault,) = faults
    assert fault.file == locked
    assert str(fault.failure).startswith("a.cpp: it is read-only; expected a file that can be fixed")
    assert "chmod u+w a.cpp" in fault.failure.advice
    assert (tmp_path / "a.cpp").read_bytes() == b"one\n"


def test_a_file_that_changed_meanwhile_is_left(tmp_path):
    one = file(tmp_path)
    (tmp_path / "a.cpp").write_bytes(b"three\n")
    written, faults = write_files([one], tmp_path)
    assert not written
    assert faults[0].failure.what == "it changed since it was read"
    assert (tmp_path / "a.cpp").read_bytes() == b"three\n"
    assert [one.name for one in tmp_path.iterdir()] == ["a.cpp"]


def test_a_file_that_is_gone_is_a_failure(tmp_path):
    written, faults = write_files([MendedFile("a.cpp", b"", b"x")], tmp_path)
    assert not written
    assert "cannot be written" in faults[0].failure.what
    assert not (tmp_path / "a.cpp").exists()


def test_what_a_link_leads_to_is_replaced_and_not_the_link(tmp_path):
    file(tmp_path, "real.cpp")
    (tmp_path / "a.cpp").symlink_to("real.cpp")
    write_files([MendedFile("a.cpp", b"one\n", b"two\n")], tmp_path)
    assert (tmp_path / "a.cpp").is_symlink()
    assert (tmp_path / "real.cpp").read_bytes() == b"two\n"
