"""What a node logged last, from files that its program could have put anything in place of."""

import os
from pathlib import Path

import pytest

from roslens.live.agent.last_log import LINES, last_lines, log_folder

ME = os.getuid()


@pytest.mark.parametrize(
    ("environment", "folder"),
    [
        (b"HOME=/home/a\0ROS_LOG_DIR=/logs\0", "/logs"),
        (b"HOME=/home/a\0ROS_HOME=/ros\0", "/ros/log"),
        (b"A=1\0HOME=/home/a\0", "/home/a/.ros/log"),
        (b"HOME=relative\0", None),
        (b"", None),
    ],
)
def test_where_a_process_logs(environment, folder):
    assert log_folder(environment) == (Path(folder) if folder else None)


def test_the_last_lines_of_the_newest_log_of_a_process(tmp_path):
    (tmp_path / "talker_7_1700000000000.log").write_text("old\n")
    (tmp_path / "talker_7_1700000000009.log").write_text("one\ntwo\n\nthree\nfour\n")
    (tmp_path / "talker_77_1700000000010.log").write_text("another\n")
    (tmp_path / "talker_7_latest.log").write_text("no time\n")
    found = last_lines(tmp_path, 7, ME)
    assert found == ("two", "three", "four")
    assert len(found) == LINES


def test_of_a_long_log_only_the_end_is_read(tmp_path):
    (tmp_path / "a_b_7_1.log").write_bytes(b"x" * 10_000_000 + b"\n\xff last\n")
    assert [len(line) <= 300 for line in last_lines(tmp_path, 7, ME)] == [True, True]
    assert last_lines(tmp_path, 7, ME)[-1].endswith(" last")


def test_links_pipes_and_files_of_others_are_not_read(tmp_path):
    secret = tmp_path / "secret"
    secret.write_text("secret\n")
    (tmp_path / "a_7_1.log").symlink_to(secret)
    os.mkfifo(tmp_path / "a_8_1.log")
    (tmp_path / "a_9_1.log").write_text("mine\n")
    assert last_lines(tmp_path, 7, ME) == ()
    assert last_lines(tmp_path, 8, ME) == ()
    assert last_lines(tmp_path, 9, ME + 1) == ()
    assert last_lines(tmp_path, 9, ME) == ("mine",)


def test_without_a_log_there_are_no_last_lines(tmp_path):
    assert last_lines(tmp_path / "missing", 7, ME) == ()
    assert last_lines(tmp_path, 7, ME) == ()
