"""How fast a distribution is checked, by engine, and in how much memory.

    python benchmarks/distribution_scale.py --packages 4000 --engine in-process --engine processes
    python benchmarks/distribution_scale.py --packages 400 --workers 1 --workers 2        a cluster of Dask, here
    python benchmarks/distribution_scale.py --of FOLDER --workers 1 --workers 2           of real packages, copied

Makes a workspace of packages in repositories of ten, each with the same few C++ and Python files under other names (or
copies the one given, without its histories), and runs `roslens check` on it cold and again. Printed are seconds by the
clock and of processors (children included), packages a second, the largest resident memory of one process, and the load
of the machine. Of a cluster also the seconds of processors of its scheduler and of its workers, how many times as fast
the most workers are as the fewest (median of the rounds), and how many times as much two processes of this machine
count together as one alone: more than that no engine gets of it.
"""

from __future__ import annotations

import argparse
import compileall
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import roslens

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


CALM = {
    "DASK_DISTRIBUTED__ADMIN__TICK__INTERVAL": "1s",
    "DASK_DISTRIBUTED__ADMIN__SYSTEM_MONITOR__INTERVAL": "5s",
    "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False",
}
"""What docs/reference/engines.md has scheduler and workers started with."""


@contextmanager
def cluster(folder: Path, workers: int) -> Iterator[tuple[str, int]]:
    """Lend the address of a scheduler, and its process; its workers are processes below it."""
    script = folder / "cluster.py"
    script.write_text(CLUSTER)
    with subprocess.Popen(
        [sys.executable, str(script), str(workers)],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=os.environ | CALM,
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
    arguments.add_argument("--rounds", type=int, default=1, help="of each number of workers")
    options = arguments.parse_args()
    # As pip leaves an installed one: without, each process that is started compiles half of it for itself.
    compileall.compile_dir(Path(roslens.__file__).parent, quiet=2)
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
        if options.workers:
            clustered(folder, options)
        peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
        print(f"largest process: {peak:,.0f} MB")


def workers_s(pid: int) -> float:
    """Return the seconds of processors that the processes below one had."""
    below = [
        int(one) for task in Path(f"/proc/{pid}/task").iterdir() for one in (task / "children").read_text().split()
    ]
    return sum(processor_s(one) + workers_s(one) for one in below)


COUNT = "import time\nend, n = time.monotonic() + 1.5, 0\nwhile time.monotonic() < end: n += 1\nprint(n)"


def together(many: int) -> int:
    """Return how far processes count in a second and a half, all together."""
    counting = [subprocess.Popen([sys.executable, "-c", COUNT], stdout=subprocess.PIPE) for _ in range(many)]
    return sum(int(one.communicate()[0]) for one in counting)


def clustered(folder: Path, options: argparse.Namespace) -> None:
    """Measure clusters of several sizes in turn, and print how they compare."""
    took: dict[int, list[float]] = {workers: [] for workers in options.workers}
    for workers in list(took) * options.rounds:
        clean(folder / "ws")
        with cluster(folder, workers) as (address, pid):
            before, below = processor_s(pid), workers_s(pid)
            seconds, cpu = check(folder / "ws", "--engine", address)
            scheduler, working = processor_s(pid) - before, workers_s(pid) - below
        took[workers].append(seconds)
        more = f", scheduler {scheduler:.1f} s ({scheduler / seconds:.0%} of a processor), workers {working:.1f} s"
        tell(f"Dask, {workers} workers", options.packages, seconds, cpu, more)
    if len(took) > 1:
        fewest, most = min(took), max(took)
        ratio = statistics.median(one / other for one, other in zip(took[fewest], took[most], strict=True))
        ceiling = statistics.median(together(2) / together(1) for _ in range(3))
        print(f"{most} workers are {ratio:.2f} times as fast as {fewest}; two bare processes count {ceiling:.2f} times")


def clean(root: Path) -> None:
    """Forget all runs and all files."""
    subprocess.run(["rm", "-rf", str(root / ".roslens")], check=True)


def tell(what: str, packages: int, took: float, cpu: float, more: str = "") -> None:
    """Print a row."""
    speed = f"{took:7.1f} s  {cpu:7.1f} s of processors  {packages / took:7.1f} packages/s"
    print(f"{what:<24} {speed}{more}, load {os.getloadavg()[0]:.1f}", flush=True)


if __name__ == "__main__":
    main()
