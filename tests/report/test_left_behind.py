"""What killed processes left beside a report is gone with the next, and an old report that one moved is back."""

import subprocess
import sys

import pytest

from roslens.report.writing.left_behind import beside, sweep
from roslens.report.writing.whole_file import whole_file


@pytest.fixture
def gone():
    """The number of a process that is no longer there."""
    with subprocess.Popen([sys.executable, "-c", ""]) as process:
        process.wait()
    return process.pid


def test_files_and_folders_of_processes_that_are_gone(tmp_path, gone):
    target = tmp_path / "report"
    target.mkdir()
    (tmp_path / f".report.{gone}.partial" / "web").mkdir(parents=True)
    (tmp_path / f".report.{gone}.old").mkdir()
    (tmp_path / f".report.{gone}.part").write_text("half")
    kept = [beside(target, "partial"), tmp_path / ".report.notes", tmp_path / f".other.{gone}.part"]
    for one in kept:
        one.write_text("")
    sweep(target)
    assert sorted(tmp_path.iterdir()) == sorted([target, *kept])


def test_an_old_report_without_a_new_one_is_back(tmp_path, gone):
    (tmp_path / f".report.{gone}.old").mkdir()
    (tmp_path / f".report.{gone}.old" / "index.html").write_text("old")
    sweep(tmp_path / "report")
    assert (tmp_path / "report" / "index.html").read_text() == "old"


def test_no_folder_is_no_error(tmp_path):
    sweep(tmp_path / "nowhere" / "report")


def test_a_file_that_is_written_sweeps(tmp_path, gone):
    (tmp_path / f".a.json.{gone}.part").write_text("half")
    with whole_file(tmp_path / "a.json") as stream:
        stream.write("{}")
    assert [one.name for one in tmp_path.iterdir()] == ["a.json"]
