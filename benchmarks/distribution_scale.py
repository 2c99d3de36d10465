"""How fast a distribution is checked, by engine, and in how much memory.

    python benchmarks/distribution_scale.py --packages 4000 --engine in-process --engine processes
    python benchmarks/distribution_scale.py --packages 400 --workers 1 --workers 2        a cluster of Dask, here
    python benchmarks/distribution_scale.py --of FOLDER --workers 1 --workers 2           of real packages, copied

Makes a workspace of packages in repositories of ten, each with the same few C++ and Python files under other names (or
copies the one given, without its histories), and runs `roslens check` on it cold and again. Printed are seconds by the
clock and of processors (children included), packages a second, the largest resident memory of one process, and for a
cluster the share of the time in which its scheduler's process used a processor.
"""

from __future__ import annotations

import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

MANIFEST = """\
<package format="3"><name>p{0}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license><depend>rclcpp</depend>
<export><build_type>ament_cmake</build_type></export></package>
"""
FUNCTION = """
int step_{0}_{1}(int x, int y)
{{
  int sum = 0;
  for (int i = 0; i < x; ++i) {{
    if (i % {1} == 0 && y > {0}) {{
      sum += i * y;
    }} else if (y < 0) {{
      sum -= x;
    }}
  }}
  return sum;
}}
"""
SCRIPT = """
class Node{0}:
    def __init__(self, rate):
        self.rate = rate

    def spin(self, times):
        for number in range(times):
            if number > self.rate:
                return number
        return {0}
"""


def make(root: Path, packages: int, functions: int) -> int:
    """Write the workspace and return how many lines it has."""
    lines = 0
    for number in range(packages):
        folder = root / f"r{number // 10}" / f"p{number}"
        folder.mkdir(parents=True)
        cpp = "".join(FUNCTION.format(number, one) for one in range(1, functions))
        python = SCRIPT.format(number) * 3
        (folder / "package.xml").write_text(MANIFEST.format(number))
        (folder / "a.cpp").write_text(cpp)
        (folder / "node.py").write_text(python)
        lines += cpp.count("\n") + python.count("\n")
    return lines


def check(root: Path, *words: str) -> tuple[float, float]:
    """Run `roslens check` and return seconds by the clock and of processors."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    command = [sys.executable, "-m", "roslens.cli.main", "check", str(root), "-q", "--no-graph", "--fail-on", "never"]
    done = subprocess.run([*command, *words], stdout=subprocess.DEVNULL, check=False)
    took, after = time.monotonic() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 3):
        raise SystemExit(f"roslens check ended with {done.returncode}")
    return took, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


CLUSTER = """
import asyncio, sys
from distributed import Nanny, Scheduler

async def run():
    async with Scheduler(host="127.0.0.1", port=0, dashboard=False) as scheduler:
        workers = [
            await Nanny(scheduler.address, nthreads=1, host="127.0.0.1", dashboard=False)
            for _ in range(int(sys.argv[1]))
        ]
        print(scheduler.address, flush=True)
        await asyncio.get_running_loop().run_in_executor(None, sys.stdin.read)
        for worker in workers:
            await worker.close()

if __name__ == "__main__":
    asyncio.run(run())
"""


@contextmanager
def cluster(folder: Path, workers: int) -> Iterator[tuple[str, int]]:
    """Lend the address of a scheduler, and its process; its workers are processes below it."""
    script = folder / "cluster.py"
    script.write_text(CLUSTER)
    with subprocess.Popen(
        [sys.executable, str(script), str(workers)],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
    ) as process:  # fmt: skip
        assert process.stdout is not None
        yield process.stdout.readline().strip(), process.pid
        process.communicate("")


def processor_s(pid: int) -> float:
    """Return the seconds of processors that one process had, its children not included."""
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main() -> None:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--packages", type=int, default=400)
    arguments.add_argument("--functions", type=int, default=40, help="of each C++ file")
    arguments.add_argument("--of", type=Path, metavar="FOLDER", help="a workspace of real packages instead")
    arguments.add_argument("--engine", action="append", default=[])
    arguments.add_argument(
        "--workers", type=int, action="append", default=[], help="of a cluster of Dask on this machine"
    )
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory(prefix="roslens-scale-") as name:
        folder = Path(name)
        if options.of:
            shutil.copytree(options.of, folder / "ws", symlinks=True, ignore=shutil.ignore_patterns(".git", ".roslens"))
            options.packages = sum(1 for _ in (folder / "ws").rglob("package.xml"))
            print(f"{options.packages:,} packages of {options.of.name}")
        else:
            lines = make(folder / "ws", options.packages, options.functions)
            print(f"{options.packages:,} packages, {lines:,} lines")
        for engine in options.engine or ([] if options.workers else ["in-process", "processes"]):
            clean(folder / "ws")
            tell(engine, options.packages, *check(folder / "ws", "--engine", engine))
            tell(f"{engine}, again", options.packages, *check(folder / "ws", "--engine", engine))
        for workers in options.workers:
            clean(folder / "ws")
            with cluster(folder, workers) as (address, pid):
                before = processor_s(pid)
                took, cpu = check(folder / "ws", "--engine", address)
                share = (processor_s(pid) - before) / took
            tell(f"Dask, {workers} workers", options.packages, took, cpu, f", scheduler {share:.0%} of a processor")
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
        print(f"largest process: {peak:,.0f} MB")


def clean(root: Path) -> None:
    """Forget all runs and all files."""
    subprocess.run(["rm", "-rf", str(root / ".roslens")], check=True)


def tell(what: str, packages: int, took: float, cpu: float, more: str = "") -> None:
    """Print a row."""
    print(f"{what:<24} {took:7.1f} s  {cpu:7.1f} s of processors  {packages / took:7.1f} packages/s{more}", flush=True)


if __name__ == "__main__":
    main()
