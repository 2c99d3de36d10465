"""What looking at computation graphs costs in ``roslens check``: the figures of the README.

    python benchmarks/check_graph_speed.py WORKSPACE… [--rounds N]

Of each workspace the files are copied to a temporary folder. There run in turn, each as a whole process with its
children: a cold check without and with graphs, the same without a cache, and a check after which nothing changed. CPU
seconds are the least of the rounds; a ratio is the median of those of the rounds.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path

from measure import run

RACY_S = 2.1
"""Files that changed less long ago are read again; see ``roslens.store.cache``."""


def spent(root: Path, *options: str, cold: bool = True) -> tuple[float, float]:
    """Return CPU seconds and peak memory in MB of a check, children included."""
    if cold:
        shutil.rmtree(root / ".roslens", ignore_errors=True)
    roslens = str(Path(sys.executable).with_name("roslens"))
    cost = run([roslens, "check", str(root), "-q", "--fail-on", "never", *options])
    return cost.cpu_s, cost.peak_mb


def compared(root: Path, rounds: int, *options: str) -> tuple[float, float, float, float]:
    """Return the CPU seconds without and with graphs, the ratio, and the peak memory with graphs in MB."""
    turns = [(spent(root, "--no-graph", *options), spent(root, *options)) for _ in range(rounds)]
    ratio = statistics.median(with_graph[0] / plain[0] for plain, with_graph in turns)
    plain, with_graph = (min(turn[place][0] for turn in turns) for place in (0, 1))
    return plain, with_graph, ratio, max(turn[1][1] for turn in turns)


def main() -> int:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("workspaces", type=Path, nargs="+")
    arguments.add_argument("--rounds", type=int, default=3)
    options = arguments.parse_args()
    print("| workspace | packages | cold | ratio | --no-cache | ratio | nothing changed | peak |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for workspace in options.workspaces:
        with tempfile.TemporaryDirectory(prefix="roslens-bench-") as scratch:
            root = Path(scratch, workspace.name)
            shutil.copytree(workspace, root, ignore=shutil.ignore_patterns(".git", ".roslens"))
            packages = sum(1 for _ in root.rglob("package.xml"))
            cold = compared(root, options.rounds)
            time.sleep(RACY_S)
            spent(root, cold=False)
            again = min(spent(root, cold=False)[0] for _ in range(options.rounds))
            uncached = compared(root, options.rounds, "--no-cache")
        print(
            f"| {workspace.name} | {packages} | {cold[0]:.2f} → {cold[1]:.2f} s | {cold[2]:.2f} | "
            f"{uncached[0]:.2f} → {uncached[1]:.2f} s | {uncached[2]:.2f} | {again:.2f} s | "
            f"{max(cold[3], uncached[3]):.0f} MB |",
            flush=True,
        )
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
