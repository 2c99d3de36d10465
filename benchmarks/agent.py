"""What the agent costs: 100 processes of 13 threads, sampled, packed and put out once a second.

    python benchmarks/agent.py

Beside it psutil's way of reading the same processes, where psutil is installed.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time

from roslens.live.agent.host import HostSampler
from roslens.live.agent.link import frame_body
from roslens.live.agent.processes import ProcessSampler
from roslens.model.wire import VERSION, Frame

PROCESSES = 100
SWEEPS = 50
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
        print(f"\npeak memory {resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f} MB")
    finally:
        for child in children:
            child.kill()
    return 0


if __name__ == "__main__":
    sys.exit(main())
