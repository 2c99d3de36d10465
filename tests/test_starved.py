"""What is known of a machine that gave no time to a test."""

import os
import signal
import subprocess
import sys
import time

import pytest
from starved import LATE_S, Sleeper, Watched
from whose_time import MOSTLY, Family, Taken, is_own

pytestmark = pytest.mark.timed


@pytest.fixture
def sleeper():
    made = Sleeper()
    yield made
    made.end()


def stop(sleeper, length_s):
    """Let nothing of the sleeper run for a while, as a busy machine does."""
    pid = sleeper._process.pid
    begun = time.monotonic()
    os.kill(pid, signal.SIGSTOP)
    while time.monotonic() - begun < length_s:
        pass
    os.kill(pid, signal.SIGCONT)


def test_a_process_that_stood_still_tells_for_how_long(sleeper):
    begun = time.monotonic()
    for _ in range(20):  # it may be stopped while it looks, and not while it sleeps
        stop(sleeper, 0.4)
        if max(sleeper.told(begun).get("late", [0.0])) >= 0.25:
            break
    else:
        pytest.fail(f"it tells {sleeper.told(begun)}")
    later = time.monotonic() + 1000
    assert sleeper.told(later) == {}, "of what was before nothing is told"
    sleeper.forget(later)
    assert sleeper._told == []


def test_it_tells_how_fast_a_loop_turns_whenever_it_is_asked(sleeper):
    found = sleeper.told(time.monotonic())
    assert min(found["slow"]) > 0.1
    assert min(found["crowded"]) > 0.9


BURN = "import sys, time\nsys.stdin.read(1)\nwhile time.monotonic() < float(sys.argv[1]): pass"


def burn(seconds):
    """Keep all processors busy with many processes; return the share of what was taken that they took."""
    family, command = Family(os.getpid(), 0), [sys.executable, "-S", "-c", BURN]
    begun = family.look()
    until = str(time.monotonic() + seconds)
    many = range(16 * len(os.sched_getaffinity(0)))
    burning = [subprocess.Popen([*command, until], stdin=subprocess.DEVNULL) for _ in many]
    for one in burning:
        one.wait()
    ended = family.look()
    return (ended.own - begun.own) / (ended.all - begun.all)


@pytest.mark.nightly  # it starves its neighbours too
def test_a_test_that_starves_itself_is_not_excused(sleeper):
    """What it started takes all processors: all is late, and others did not do it."""
    watched, shares = Watched(sleeper), []
    for _ in range(5):
        watched.begin(time.monotonic())
        shares.append(burn(1.5))
        told = sleeper.told(watched._begun)
        own = max(max(told.get(f"own {what}", [0.0])) for what in ("late", "crowded"))
        if own > LATE_S and watched.starved() == "":
            return
    if min(shares) < MOSTLY + 0.1:
        pytest.skip(f"others have the machine: what the test started got {shares} of what was taken")
    pytest.fail(f"it is excused by {watched.starved()}")


@pytest.mark.parametrize(
    ("own_s", "all_s", "late_s", "is_it"),
    [
        (2.0, 2.0, 1.0, True),
        (1.8, 2.0, 1.0, True),
        (1.6, 2.0, 1.0, False),  # others had a fifth
        (0.2, 2.0, 1.0, False),
        (0.3, 0.3, 1.0, False),  # the machine stood still, and nobody took it
        (0.0, 0.0, 0.2, False),
        (0.3, 0.3, 0.2, True),  # shortly, but all of it
    ],
)
def test_whose_doing_it_was(own_s, all_s, late_s, is_it):
    assert is_own(Taken(5.0, 100.0, 10.0), Taken(7.0, 100.0 + all_s, 10.0 + own_s), late_s, 2) is is_it


def test_what_is_taken_by_those_that_were_started_and_have_ended_counts():
    family = Family(os.getpid(), 0)
    before = family.look()
    spin = "import time\nwhile time.process_time() < 0.3: pass"
    subprocess.run([sys.executable, "-S", "-c", spin], check=True)
    assert family.look().own - before.own >= 0.25
    child = subprocess.Popen([sys.executable, "-S", "-c", spin.replace("0.3", "0.6")])
    family.look()
    while child.poll() is None:
        time.sleep(0.01)
    assert family.look().own - before.own >= 0.75
    assert family.look().all >= before.all


def test_it_says_so_when_it_has_ended(sleeper):
    sleeper._process.kill()
    sleeper._process.wait()
    with pytest.raises((RuntimeError, BrokenPipeError)):
        sleeper.told(0.0)


class Told:
    def __init__(self, **told):
        self.all = told
        self.asked = None

    def forget(self, before):
        self.asked = before

    def told(self, begun):
        assert begun == self.asked
        return self.all


@pytest.mark.parametrize(
    ("told", "said"),
    [
        ({}, ""),
        ({"late": [0.09], "slow": [1.5, 1.6], "crowded": [1.1, 2.0]}, ""),
        ({"late": [0.12, 0.5]}, "a sleeping process was woken 0.50 s late"),
        ({"slow": [2.44, 1.0]}, "an empty loop took 2.4 times what it takes on a calm machine"),
        ({"own late": [3.0], "own slow": [9.0], "own crowded": [9.0]}, ""),
        ({"crowded": [3.0]}, "a loop took 3.0 times what it took of a processor, for others had it"),
    ],
)
def test_what_was_noticed_is_said(told, said):
    watched = Watched(Told(**told))
    watched.begin(7.0)
    assert watched.starved() == said
