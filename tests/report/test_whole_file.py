import os
import threading

import pytest

from roslens.report.writing.whole_file import whole_file


def test_the_new_takes_the_place_of_the_old_at_the_end(tmp_path):
    path = tmp_path / "deep" / "report.json"
    with whole_file(path) as stream:
        stream.write("one\n")
        assert not path.exists()
    with whole_file(path) as stream:
        stream.write("two\n")
        stream.flush()
        assert path.read_text() == "one\n"
    assert path.read_text() == "two\n"
    assert [one.name for one in path.parent.iterdir()] == ["report.json"]


def test_a_failure_leaves_the_old_and_nothing_else(tmp_path):
    path = tmp_path / "report.json"
    path.write_text("old")
    with pytest.raises(ValueError, match="I/O operation on closed file"), whole_file(path) as stream:
        _fail_half_way(stream)
    assert path.read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 1


def _fail_half_way(stream):
    stream.write("half")
    stream.close()
    stream.write("the rest")


def test_what_a_link_points_to_is_replaced(tmp_path):
    path, link = tmp_path / "report.json", tmp_path / "latest.json"
    path.write_text("old")
    link.symlink_to(path)
    with whole_file(link) as stream:
        stream.write("new")
    assert link.is_symlink()
    assert path.read_text() == "new"


def test_a_pipe_stays_a_pipe(tmp_path):
    path = tmp_path / "pipe"
    os.mkfifo(path)
    read = []
    reader = threading.Thread(target=lambda: read.append(path.read_text()))
    reader.start()
    with whole_file(path) as stream:
        stream.write("through")
    reader.join()
    assert read == ["through"]
    assert path.is_fifo()
