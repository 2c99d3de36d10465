"""What the agent costs: 100 processes of 13 threads, sampled, packed and put out once a second.

    python benchmarks/agent.py

Then what it costs to read what the nodes of 100 processes count (2 topics with messages, 3 without), as often as the
agent reads it. Beside it psutil's way of reading the same processes, where psutil is installed.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time

from roslens.live.agent.host import HostSampler
from roslens.live.agent.link import frame_body
from roslens.live.agent.processes import ProcessSampler
from roslens.live.agent.work import COUNT_EVERY_S, COUNT_SHARE
from roslens.live.inside import slots
from roslens.live.inside.counter_file import CounterFile
from roslens.live.inside.host_counters import HostCounters
from roslens.live.inside.slots import VARIABLE, Slot
from roslens.model.wire import VERSION, Frame

PROCESSES = 100
SWEEPS = 50
SECONDS = 6
CHILD = """import threading, sys
for _ in range(12):
    threading.Thread(target=sys.stdin.read, daemon=True).start()
print(flush=True)
sys.stdin.read()
"""


def main() -> int:
    """Measure and print a table."""
    children = [
        subprocess.Popen([sys.executable, "-c", CHILD, "--ros-args"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        for _ in range(PROCESSES)
    ]
    try:
        for child in children:
            if child.stdout is not None:
                child.stdout.readline()
        host, processes = HostSampler("here"), ProcessSampler("here")
        processes.find(0.0)
        begun = time.process_time()
        found = 0
        for sweep in range(SWEEPS):
            if sweep % 2 == 0:
                processes.find(float(sweep))
            samples = [host.sample(float(sweep)), *processes.sample(float(sweep))]
            found = len(samples) - 1
            frame_body(Frame(VERSION, "here/agent", sweep, float(sweep), samples=samples))
        ours = (time.process_time() - begun) / SWEEPS
        print(
            f"{found} processes, {SWEEPS} sweeps\n\n| reader | ms a sweep | % of a core at 1 Hz |\n| --- | --- | --- |"
        )
        print(f"| roslens agent | {ours * 1e3:.2f} | {ours * 100:.2f} |")
        try:
            import psutil  # type: ignore[import-untyped,unused-ignore]
        except ModuleNotFoundError:
            print("| psutil | not installed | |")
        else:
            watched = [psutil.Process(child.pid) for child in children]
            begun = time.process_time()
            for _ in range(SWEEPS):
                for one in watched:
                    one.as_dict(["cpu_times", "memory_info", "num_threads"])
            theirs = (time.process_time() - begun) / SWEEPS
            print(f"| psutil: cpu, memory, threads | {theirs * 1e3:.2f} | {theirs * 100:.2f} |")
        for rate in (1, 10):
            print(counting_row(rate))
        print(f"\npeak memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB")
    finally:
        for child in children:
            child.kill()
    return 0


def counting_row(rate: int) -> str:
    """Measure the reading of counters and return a row of the table."""
    shared = "/dev/shm"
    with tempfile.TemporaryDirectory(dir=shared) as folder:
        files = [CounterFile(folder, 64) for _ in range(PROCESSES)]
        busy: list[Slot | None] = []
        for at, file in enumerate(files):
            busy += [file.slot(slots.TAKEN, os.urandom(16), f"/in{at}", f"/node{at}")]
            busy += [file.slot(slots.PUBLISHED, b"", f"/out{at}", f"/node{at}")]
            for topic in ("/parameter_events", "/rosout", "/tf_static"):
                file.slot(slots.PUBLISHED, b"", topic, f"/node{at}")
        counters = HostCounters("here", {VARIABLE: folder})
        begun = time.time()
        counters.read(begun)
        spent = 0.0
        reads = int(SECONDS / COUNT_EVERY_S)
        for read in range(1, reads + 1):
            now = begun + read * COUNT_EVERY_S
            for at, slot in enumerate(busy):
                due = [int((read - 1 + back) * COUNT_EVERY_S * rate + at / len(busy)) for back in (0, 1)]
                for _ in range(due[1] - due[0]):
                    if slot is not None:
                        slot.published(int(now * 1e9), 100)
            before = time.process_time()
            for place, tallies in counters.read(now):
                frame_body(Frame(VERSION, "here/agent", read, now, tallies, counted_at=place))
            spent += time.process_time() - before
        counters.close()
        for file in files:
            file.close()
    ours = spent / reads
    every = min(max(COUNT_EVERY_S, ours / COUNT_SHARE), 1.0)
    share = 100 * ours / every
    return f"| counters, {rate} Hz, every {every:.2f} s | {ours * 1e3:.2f} a read | {share:.2f} |"


if __name__ == "__main__":
    sys.exit(main())
