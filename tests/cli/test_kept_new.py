"""What is kept of what is new: of its run alone, and nothing that somebody wrote there."""

import pytest

from roslens.cli.check.kept_new import keep_new, kept_new
from roslens.model.finding import Severity
from roslens.model.result import RuleCount

FIRST = (RuleCount("a.b", Severity.WARNING, 1, 1, "a.cpp:1: m"),)


def test_it_is_of_its_run(tmp_path):
    keep_new(tmp_path, 3, "HEAD", FIRST)
    assert kept_new(tmp_path, 3) == FIRST
    assert kept_new(tmp_path, 4) == ()


def test_a_check_without_a_baseline_takes_it_away(tmp_path):
    keep_new(tmp_path, 3, "HEAD", FIRST)
    keep_new(tmp_path, 3, "", None)
    assert kept_new(tmp_path, 3) == ()
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"run": "3", "baseline": "", "first": []}', b"\xff"])
def test_what_is_no_such_file_is_nothing(tmp_path, content):
    keep_new(tmp_path, 3, "HEAD", FIRST)
    (place,) = tmp_path.iterdir()
    place.write_bytes(content)
    assert kept_new(tmp_path, 3) == ()


def test_a_folder_that_cannot_be_written_keeps_nothing(tmp_path):
    keep_new(tmp_path / "none", 3, "HEAD", FIRST)
    assert kept_new(tmp_path / "none", 3) == ()
