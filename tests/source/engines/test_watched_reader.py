"""A process that reads for one that goes on: what ends it costs one file, and the next question has another process."""

import os
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from roslens.intake.time_budget import OverBudgetError
from roslens.model.errors import DocumentError
from roslens.source.engines.watched_reader import LostReaderError, WatchedReader

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")


@pytest.fixture
def reader(tmp_path):
    made = WatchedReader(str(tmp_path))
    yield made
    made.end()


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("abort", "or breaks the parser"),
        ("large", "MB of memory"),
        ("slow", "1 s of processor time"),
        ("spin", "s of processor time"),
    ],
)
def test_one_file_is_lost_and_named_and_the_others_are_read(reader, reading, tmp_path, written, text, why):
    written(before="1", bad=text, after="2")
    _, found = reader.ask(reading.read, str(tmp_path), "before", "bad", "after")
    assert found.pop("bad").startswith("left out: it ")
    assert found == {"before": "1", "after": "2"}
    # It is left out at no cost until it changes.
    pid, found = reader.ask(reading.read, str(tmp_path), "bad", "after")
    assert why in found["bad"]
    assert reader.ask(reading.printed) == ["bad"]
    written(bad="3 is good")
    assert reader.ask(reading.read, str(tmp_path), "bad") == (pid, {"bad": "3 is good"})
    assert reader.ask(reading.printed) == []


def test_what_was_written_since_the_question_is_read_again(reader, reading, tmp_path):
    (tmp_path / "bad").write_text("abort")
    os.utime(tmp_path / "bad", (time.time() + 60, time.time() + 60))
    _, found = reader.ask(reading.read, str(tmp_path), "bad")
    assert "breaks the parser" in found["bad"]
    assert reader.ask(reading.printed) == []


def test_several_are_lost_each_by_its_name(reader, reading, tmp_path, written):
    written(one="abort", two="abort", three="3")
    _, found = reader.ask(reading.read, str(tmp_path), "one", "two", "three")
    assert [name for name, text in found.items() if text.startswith("left out")] == ["one", "two"]


def test_the_next_question_has_the_same_process(reader, reading, tmp_path, written):
    written(one="1")
    assert reader.ask(reading.read, str(tmp_path), "one")[0] == reader.ask(reading.read, str(tmp_path), "one")[0]
    assert reader.ask(reading.read, str(tmp_path))[0] != os.getpid()


def test_errors_are_those_of_the_function(reader, reading):
    with pytest.raises(DocumentError, match=r"a\.yaml: a key; expected none") as raised:
        reader.ask(reading.wrong, "a.yaml")
    assert raised.value.expected == "none"


def test_a_process_that_ends_by_itself_is_told_and_replaced(reader, reading):
    with pytest.raises(LostReaderError, match="exit code 7"):
        reader.ask(reading.lost)
    assert reader.ask(reading.printed) == []


def test_what_is_told_meanwhile_is_heard_here(reader, reading):
    heard = []
    assert reader.ask(reading.told, 3, heard=lambda *told: heard.append(told)) == 3
    assert heard == [("step", 0), ("step", 1), ("step", 2)]


def test_who_listens_may_fail(reader, reading):
    def broken(*_told):
        raise OverBudgetError("enough")

    with pytest.raises(OverBudgetError, match="enough"):
        reader.ask(reading.told, 3, heard=broken)
    assert reader.ask(reading.printed) == []


def test_a_thread_that_is_gone_takes_its_process_with_it(reader, reading, tmp_path):
    with ThreadPoolExecutor(1) as other:
        pid, _ = other.submit(reader.ask, reading.read, str(tmp_path)).result()
    end = time.monotonic() + 30
    while Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z":
        assert time.monotonic() < end
        os.sched_yield()
    assert reader.ask(reading.printed) == []
