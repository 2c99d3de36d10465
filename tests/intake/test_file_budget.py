"""What reading a file may take: inner bounds raise, the kernel ends the process, and what is in hand is known."""

import faulthandler
import os
import resource
import signal
import time

import pytest

from roslens.intake import file_budget as module
from roslens.intake.file_budget import (
    LEAST_MEMORY,
    MOST_MEMORY,
    Slot,
    begin_reading,
    file_budget,
    memory_of_file,
    most_jobs,
    refuse,
    refused,
    share_memory,
    unwatch,
    watch,
    why_ended,
)
from roslens.intake.time_budget import OverBudgetError


@pytest.fixture(autouse=True)
def _nothing_left_out():
    begin_reading()
    yield
    unwatch()
    share_memory(0)
    begin_reading()


def test_a_file_that_takes_too_long_is_left_out_from_then_on():
    with pytest.raises(OverBudgetError, match=r"more than 0\.05 s") as raised, file_budget("a/b.xml", seconds=0.05):
        busy(60)
    assert raised.value.subject == "a/b.xml"
    with pytest.raises(OverBudgetError, match=r"more than 0\.05 s"), file_budget("a/b.xml"):
        pytest.fail("it is read again")
    assert list(refused()) == ["a/b.xml"]
    begin_reading()
    with file_budget("a/b.xml"):
        pass


def test_the_time_of_a_file_inside_another_one_is_its_own():
    with pytest.raises(OverBudgetError) as raised:
        nested(0.4, ("inner", 5, 0.5), ("endless", 0.05, 5))
    assert raised.value.subject == "endless"
    begin_reading()
    with pytest.raises(OverBudgetError) as raised:
        nested(0.2, ("inner", 5, 0.3), after=5)
    assert raised.value.subject == "outer"


def nested(seconds, *inner, after=0):
    with file_budget("outer", seconds=seconds):
        for subject, most, takes in inner:
            with file_budget(subject, seconds=most):
                busy(takes)
        busy(after)


def busy(seconds):
    begun = time.process_time()
    while time.process_time() - begun < seconds:
        pass


def test_memory_that_is_not_given_is_told_as_such():
    with pytest.raises(OverBudgetError, match="MB of memory"), file_budget("a.yaml"):
        raise MemoryError


def in_a_child(work, slot):
    """Return how a process ends that does something while another one watches."""
    pid = os.fork()
    if pid == 0:
        code = 3
        try:
            faulthandler.disable()
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            watch(slot)
            work()
            code = 0
        finally:
            os._exit(code)
    _, status = os.waitpid(pid, 0)
    return os.waitstatus_to_exitcode(status)


def test_the_kernel_ends_what_nothing_else_ends_and_the_file_in_hand_is_known(monkeypatch):
    monkeypatch.setattr(module, "MORE_S", 0.0)
    slot = Slot()

    def deaf():
        # Neither the timer nor the parser is asked: what C code does in one long call.
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGPROF})
        with file_budget("outer.launch"), file_budget("deaf.launch", seconds=1):
            signal.setitimer(signal.ITIMER_PROF, 0)
            while True:
                pass

    code = in_a_child(deaf, slot)
    assert code == -signal.SIGXCPU
    assert slot.get()[1] == "deaf.launch"
    assert "s of processor time" in why_ended(code)


def test_the_kernel_gives_no_more_memory_than_a_file_may_take(monkeypatch):
    monkeypatch.setattr(module, "memory_of_file", lambda: 200_000_000)
    slot = Slot()

    def large():
        with file_budget("large.yaml"):
            bytearray(400_000_000)

    def fits():
        with file_budget("fits.yaml"):
            bytearray(20_000_000)
        # Outside of files nothing is bounded.
        bytearray(400_000_000)

    assert in_a_child(large, slot) == 3
    assert in_a_child(fits, slot) == 0
    assert slot.get()[1] == ""
    code = in_a_child(os.abort, slot)
    assert "or breaks the parser" in why_ended(code)
    assert why_ended(-signal.SIGTERM) == why_ended(1) == ""


def test_outside_of_a_watched_process_the_kernel_is_not_asked():
    before = resource.getrlimit(resource.RLIMIT_AS), resource.getrlimit(resource.RLIMIT_CPU)
    with file_budget("a.cpp"):
        assert (resource.getrlimit(resource.RLIMIT_AS), resource.getrlimit(resource.RLIMIT_CPU)) == before


def test_what_the_watching_process_says_is_left_out():
    refuse({"bad.cpp": "it takes more than 10 s of processor time"})
    with pytest.raises(OverBudgetError, match="more than 10 s"), file_budget("bad.cpp"):
        pytest.fail("it is read")


def test_half_of_the_memory_is_shared_out(monkeypatch):
    whole = {"SC_PHYS_PAGES": 16_000_000_000 // 4096, "SC_PAGE_SIZE": 4096}
    monkeypatch.setattr(module.os, "sysconf", lambda name: whole[name])
    for processors, memory in ((2, MOST_MEMORY), (8, 1_000_000_000), (64, LEAST_MEMORY)):
        monkeypatch.setattr(module.os, "cpu_count", lambda count=processors: count)
        assert abs(memory_of_file() - memory) < 10_000
    assert abs(memory_of_file(10) - 800_000_000) < 10_000
    share_memory(10)
    assert abs(memory_of_file() - 800_000_000) < 10_000
    # No more processes than half of the memory has shares for.
    assert most_jobs() * LEAST_MEMORY <= 8_000_000_000 < (most_jobs() + 1) * LEAST_MEMORY


def test_the_parts_of_a_slot_are_apart():
    slot = Slot(3)
    for number in range(3):
        slot.of(number).put(f"file{number}.cpp")
    slot.of(1).put("")
    assert [slot.of(number).get()[1] for number in range(3)] == ["file0.cpp", "", "file2.cpp"]
    slot.of(2).put("ü\udcff" * 5000)
    assert slot.of(2).get()[0] == os.getpid()
