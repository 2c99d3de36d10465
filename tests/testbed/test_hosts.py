import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from pace import slowness

from testbed import leftovers
from testbed.hosts import Bed
from testbed.machine import BedError, wait_until
from testbed.measure import round_trips, throughput

pytestmark = pytest.mark.real

# A program of its own, so that it can be ended from outside while it holds a bed.
HOLDER = """
import sys, time
from testbed.hosts import Bed
with Bed(["one", "two"]) as bed:
    process = bed["one"].start(["sleep", "600"])
    print(bed.stem, process.pid, flush=True)
    while True:  # a signal just before one long sleep would be served after it
        time.sleep(0.05)
"""


def is_alive(pid: int) -> bool:
    return Path(f"/proc/{pid}").exists()


def state_of_parent(pid: int) -> str:
    parent = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1]
    return Path(f"/proc/{parent}/stat").read_text().rpartition(")")[2]


@pytest.fixture
def holder(allowed):
    tests = str(Path(__file__).parents[1])
    process = subprocess.Popen(
        [sys.executable, "-c", HOLDER], env={**os.environ, "PYTHONPATH": tests}, stdout=subprocess.PIPE, text=True
    )
    assert process.stdout is not None
    stem, pid = process.stdout.readline().split()
    yield process, stem, int(pid)
    process.kill()
    process.stdout.close()
    process.wait()


@pytest.mark.parametrize("link", ["bulk", "shaped"])
def test_hosts_come_and_go(allowed, link):
    with Bed(["one", "two"], link) as bed:
        assert {host.namespace for host in bed} <= set(leftovers.namespaces(bed.stem))
        sleeping = bed["one"].start(["sleep", "600"])
        assert sleeping.running
        assert is_alive(sleeping.pid)
        pids = [sleeping.pid, *(host.pid for host in bed)]
    assert leftovers.namespaces(bed.stem) == []
    assert not bed.folder.exists()
    assert [pid for pid in pids if is_alive(pid)] == []
    assert bed.stem not in Path("/proc/self/mountinfo").read_text()
    assert bed.stem not in subprocess.run(["ps", "ax", "-o", "args"], capture_output=True, text=True).stdout


def test_a_failure_inside_leaves_nothing(allowed):
    with pytest.raises(ZeroDivisionError), Bed(["one"]) as bed:
        raise ZeroDivisionError
    assert leftovers.namespaces(bed.stem) == []


def test_a_failure_on_the_way_up_leaves_nothing(allowed):
    bed = Bed(["one", "a/b"])
    with pytest.raises(BedError, match="a/b"):
        bed.__enter__()
    assert leftovers.namespaces(bed.stem) == []
    assert not bed.folder.exists()


def test_a_terminated_bed_cleans_up(holder):
    process, stem, pid = holder
    process.terminate()
    assert process.wait(60) == 128 + signal.SIGTERM
    assert leftovers.namespaces(stem) == []
    assert not is_alive(pid)


def test_a_killed_bed_takes_its_processes_along_and_the_next_one_sweeps(holder):
    process, stem, pid = holder
    process.kill()
    process.wait()
    wait_until("the programs of the killed bed are gone", lambda: not is_alive(pid), 60)
    assert leftovers.namespaces(stem) != []
    with Bed(["one"]):
        assert leftovers.namespaces(stem) == []


def test_a_living_bed_is_not_swept(bulk):
    leftovers.sweep()
    assert leftovers.namespaces(bulk.stem) != []


def test_a_host_sees_itself_and_nobody_else(bulk):
    here = bulk["here"]
    sleeping = bulk["there"].start(["sleep", "599"])
    assert here.run(["hostname"]).stdout == "here\n"
    seen = here.run(["sh", "-c", "cat /proc/[0-9]*/cmdline"]).stdout
    assert "host_init.py" in seen
    assert "599" not in seen
    there = bulk["there"].run(["cat", f"/proc/{sleeping.inner_pid}/cmdline"]).stdout
    assert "599" in there
    sleeping.kill()


def test_hosts_know_each_other_by_name(bulk):
    assert bulk["there"].address in bulk["here"].run(["getent", "hosts", "there"]).stdout


def test_the_callers_ros_does_not_leak_in(bulk, monkeypatch):
    for name in ("ROS_MASTER_URI", "LD_LIBRARY_PATH", "_ROS_WHEELS_BOOTSTRAP_COMPLETE", "PYTHONPATH"):
        monkeypatch.setenv(name, "/nowhere")
    assert "/nowhere" not in bulk["here"].run(["env"], {"OWN": "1"}).stdout


def test_a_frozen_program_does_not_hold_up_the_end(allowed):
    with Bed(["one"]) as bed:
        frozen = bed["one"].start(["sleep", "600"])
        frozen.send(signal.SIGSTOP)
        wait_until("nsenter has stopped too", lambda: " T " in state_of_parent(frozen.pid), 60)
        began = time.monotonic()
    assert time.monotonic() - began < 60, "it sleeps for ten minutes"
    assert not is_alive(frozen.pid)


def test_a_program_that_fails_says_so(bulk):
    with pytest.raises(BedError, match=r"'here' ended with 3.*'oh'"):
        bulk["here"].run(["sh", "-c", "echo oh >&2; exit 3"])
    with pytest.raises(BedError, match=r"over 0\.2 s"):
        bulk["here"].run(["sleep", "60"], limit=0.2)


def test_two_beds_do_not_meet(bulk):
    knock = ["bash", "-c", f"exec 3<>/dev/tcp/{bulk['there'].address}/7007"]
    with Bed(["here", "there"]) as other:
        assert other["here"].run(knock, check=False).returncode != 0
        assert bulk["here"].run(knock, check=False).returncode == 0
    assert round_trips(bulk["here"], bulk["there"], 5)["answered"] == 5


@pytest.mark.parametrize(("bed", "megabytes"), [("bulk", 200), ("shaped", 20)])
def test_a_stream_arrives_whole(request, bed, megabytes):
    bed = request.getfixturevalue(bed)
    assert throughput(bed["here"], bed["there"], megabytes) > 20e6 / slowness()


def test_a_process_ends_with_its_code_and_starts_again(bulk):
    process = bulk["here"].start(["sh", "-c", "echo life; exit 4"], name="lives")
    assert process.wait(60) == 4
    process.start_again()
    assert process.wait(60) == 4
    assert process.output() == "life\nlife\n"


def test_a_running_process_is_not_started_twice(bulk):
    process = bulk["here"].start(["sleep", "600"], name="once")
    with pytest.raises(RuntimeError, match="once"):
        process.start_again()
    process.stop()
    assert not process.running


def test_multicast_reaches_the_other_host(bulk, shaped):
    listen = (
        "import socket,struct;s=socket.socket(socket.AF_INET,socket.SOCK_DGRAM);s.bind(('',7400));"
        "s.setsockopt(0,35,struct.pack('4sl4s',socket.inet_aton('239.255.0.1'),0,socket.inet_aton('0.0.0.0')));"
        "print('ready',flush=True);print(s.recv(9).decode(),flush=True)"
    )
    tell = "import socket;socket.socket(socket.AF_INET,socket.SOCK_DGRAM).sendto(b'robot',('239.255.0.1',7400))"
    for bed in (bulk, shaped):
        listener = bed["there"].start([sys.executable, "-c", listen], name="listener")
        wait_until("the listener is ready", lambda of=listener: "ready" in of.output(), 60)
        bed["here"].run([sys.executable, "-c", tell])
        wait_until("multicast arrives", lambda of=listener: "robot" in of.output(), 60)
