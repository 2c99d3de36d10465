import json
import os
import signal
import time
from pathlib import Path

import pytest
from pace import slowness

from testbed import faults
from testbed.clock import faked, library, shifted
from testbed.machine import BedError, wait_until
from testbed.measure import PROBE, round_trips, throughput

pytestmark = pytest.mark.real


def stat(pid: int) -> list[str]:
    """Fields of /proc/<pid>/stat from the third (state) on."""
    return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()


def test_a_delay_both_ways_doubles(shaped):
    with faults.delay(shaped, "here", 20), faults.delay(shaped, "there", 20):
        found = round_trips(shaped["here"], shaped["there"], 100, 0.01)
    assert min(found["rtt_ms"]) == pytest.approx(40, abs=5)
    assert found["answered"] == 100
    assert min(round_trips(shaped["here"], shaped["there"], 50)["rtt_ms"]) < 5


@pytest.mark.parametrize("bed", ["bulk", "shaped"])
def test_loss_is_the_share_asked_for(request, bed):
    bed = request.getfixturevalue(bed)
    with faults.loss(bed, "here", 20) as fault:
        found = round_trips(bed["here"], bed["there"], 1000, 0.002)
    assert 100 * (1 - found["answered"] / found["sent"]) == pytest.approx(20, abs=5)  # four standard deviations of 1.26
    assert fault.began < fault.ended
    assert round_trips(bed["here"], bed["there"], 50, 0.003)["answered"] == 50


@pytest.mark.parametrize("bed", ["bulk", "shaped"])
def test_rate_is_the_limit_asked_for(request, bed):
    bed = request.getfixturevalue(bed)
    with faults.rate(bed, "here", 10e6):
        found = [throughput(bed["here"], bed["there"], 2)]
        while found[-1] < 7.5e6 and len(found) < 5:  # a machine that stands still takes away from it
            found.append(throughput(bed["here"], bed["there"], 2))
    assert max(found) == pytest.approx(10e6, rel=0.25)
    assert throughput(bed["here"], bed["there"], 5) > 20e6 / slowness()


def test_the_bridge_cannot_delay_and_says_so(bulk):
    with pytest.raises(BedError, match="link='shaped'"), faults.delay(bulk, "here", 20):
        pass


def test_wrong_settings_of_the_switch_are_named(shaped):
    assert shaped.switch is not None
    with pytest.raises(ValueError, match="attic"):
        shaped.switch.change("attic", delay_ms=1)
    with pytest.raises(ValueError, match="dealy_ms"):
        shaped.switch.change("here", dealy_ms=1)


@pytest.mark.parametrize("bed", ["bulk", "shaped"])
def test_an_unplugged_host_answers_again_when_plugged_in(request, bed):
    bed = request.getfixturevalue(bed)
    with faults.unplugged(bed, "there"):
        assert round_trips(bed["here"], bed["there"], 5, 0.01)["answered"] == 0
    found = round_trips(bed["here"], bed["there"], 20, 0.05)
    assert found["answered"] > 10
    assert "224.0.0.0/4" in bed["there"].run(["ip", "route"]).stdout


def test_a_fault_ends_after_a_failure_inside(bulk):
    with pytest.raises(ZeroDivisionError), faults.loss(bulk, "here", 100) as fault:
        raise ZeroDivisionError
    assert fault.ended is not None
    assert round_trips(bulk["here"], bulk["there"], 5)["answered"] == 5


def test_detection_time_counts_from_the_begin():
    with faults.in_force("test", "here", lambda: None, lambda: None) as fault:
        assert fault.ended is None
    assert fault.after(fault.began + 2.5) == 2.5


def test_a_burning_cpu_burns(bulk):
    with faults.cpu_burn(bulk["here"]):
        burner = bulk["here"].processes[-1]
        used = lambda: sum(map(int, stat(burner.pid)[11:13])) / os.sysconf("SC_CLK_TCK")  # noqa: E731
        wait_until("the burner has burnt 0.2 s", lambda: used() > 0.2, 20)
    assert not burner.running


def test_a_leak_grows_up_to_its_limit(bulk):
    def held() -> float:
        return int(Path(f"/proc/{leaking.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6

    with faults.memory_leak(bulk["here"], 50, limit_mb=30):
        leaking = bulk["here"].processes[-1]
        wait_until("30 MB are held", lambda: held() > 30, 20)
        assert held() < 60
    assert not leaking.running


def test_a_full_disk_has_no_byte_left(bulk):
    here, there = bulk["here"], bulk["there"]
    write = ["sh", "-c", f"echo more >{here.disk}/more"]
    with faults.full_disk(here):
        assert here.run(write, check=False).returncode != 0
        assert there.run(["sh", "-c", f"echo more >{there.disk}/more"]).returncode == 0
    assert here.run(write).returncode == 0


def test_a_frozen_process_does_nothing_and_thaws(bulk):
    counter = bulk["here"].start(["sh", "-c", "while sleep 0.02; do echo tick; done"], name="counter")
    wait_until("it ticks", lambda: "tick" in counter.output(), 60)
    with faults.frozen(counter):
        wait_until("it is stopped", lambda: stat(counter.pid)[0] == "T", 60)
        ticks = len(counter.output())
        assert counter.running
    wait_until("it ticks again", lambda: len(counter.output()) > ticks, 60)
    counter.kill()


def test_a_process_that_was_frozen_and_killed_from_outside_has_ended(bulk):
    victim = bulk["here"].start(["sleep", "600"], name="frozen-victim")
    victim.send(signal.SIGSTOP)
    wait_until("it is stopped", lambda: stat(victim.pid)[0] == "T", 60)
    bulk["here"].run(["kill", "-9", str(victim.inner_pid)])
    assert victim.wait(60) == -9


def test_a_killed_process_is_gone_and_comes_back_as_another(bulk):
    victim = bulk["here"].start(["sleep", "600"], name="victim")
    before = victim.pid
    with faults.killed(victim):
        assert not victim.running
        assert victim.code == -9
    assert victim.running
    assert victim.pid != before
    victim.kill()


def test_a_restarted_process_is_asked_first(bulk):
    script = "trap 'echo bye; exit 0' INT; echo hello; while :; do sleep 0.05; done"
    polite = bulk["here"].start(["sh", "-c", script], name="polite")
    wait_until("it is there", lambda: "hello" in polite.output(), 60)
    with faults.restarted(polite):
        wait_until("it is there again", lambda: polite.output() == "hello\nbye\nhello\n", 60)
    polite.kill()


@pytest.mark.skipif(library() is None, reason="faketime is not installed: apt-get install faketime")
def test_a_clock_offset_is_seen_by_programs_of_the_host(bulk):
    here = bulk["here"]
    environment = faked(here)

    def assert_offset(expected: float) -> None:
        """The moment that a program tells lies between those before and after it ran, which may be long ones."""
        least, most = -float("inf"), float("inf")
        for _ in range(3):
            before = time.time()
            told = json.loads(here.run([*PROBE, "clock"], environment).stdout)
            least, most = max(least, told - time.time()), min(most, told - before)
        assert least - 0.02 <= expected <= most + 0.02

    assert_offset(0)
    with shifted(here, 0.25):
        assert_offset(0.25)
    with shifted(here, -3.0):
        assert_offset(-3.0)
    assert_offset(0)


@pytest.mark.skipif(library() is None, reason="faketime is not installed: apt-get install faketime")
def test_a_clock_offset_reaches_a_program_that_runs_already(bulk):
    script = "import time\nwhile True: print(time.time(), flush=True); time.sleep(0.05)"
    running = bulk["here"].start(["/usr/bin/python3", "-c", script], faked(bulk["here"]), name="clock-reader")

    def offset() -> float:
        return float(running.output().split()[-2]) - time.time()

    wait_until("it runs", lambda: running.output().count("\n") > 1, 60)
    with shifted(bulk["here"], 5):
        wait_until("it sees the offset", lambda: abs(offset() - 5) < 1, 60)
    wait_until("it sees the end", lambda: abs(offset()) < 1, 60)
    running.kill()
