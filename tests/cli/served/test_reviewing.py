"""What is accepted on pages is read in the process that answers only where it is small."""

import sys

import pytest
from cli.broken_parser import BREAKING

from roslens.cli.served import reviewing as module
from roslens.cli.served.reviewing import Reviewing

ENTRY = """
[[accepted]]
fingerprint = "{}"
reason = "{}"
"""


@pytest.fixture
def place(tmp_path, monkeypatch):
    """Return a file that breaks every process that reads it but this one."""
    (tmp_path / "sitecustomize.py").write_text(BREAKING)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    path = tmp_path / "roslens.accepted.toml"
    monkeypatch.setenv("BROKEN_BY", str(path))
    return path


def nothing():
    return ()


def test_a_small_file_is_read_here(place):
    place.write_text(ENTRY.format("1", "as meant"))
    assert Reviewing(place, nothing).entries()["1"].reason == "as meant"


def test_a_large_file_is_read_in_a_process_of_its_own(place, monkeypatch):
    monkeypatch.setenv("BROKEN_BY", "")
    monkeypatch.setattr(module, "MOST_HERE", 100)
    place.write_text("".join(ENTRY.format(number, "as meant") for number in range(10)))
    reviewing = Reviewing(place, nothing)
    assert len(reviewing.entries()) == 10
    assert reviewing.undo("3") == ""
    assert len(reviewing.entries()) == 9


@pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")
def test_one_that_ends_the_process_is_told_and_the_pages_stay(place, monkeypatch):
    monkeypatch.setattr(module, "MOST_HERE", 100)
    place.write_text("".join(ENTRY.format(number, "as meant") for number in range(10)))
    reviewing = Reviewing(place, nothing)
    assert reviewing.entries() == {}
    assert "or breaks the parser" in reviewing.undo("1")
