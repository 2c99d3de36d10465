"""How long a complete study of many repositories takes, cold and again, and in how much memory.

    python benchmarks/study_speed.py FOLDER                    the 48 repositories of the study of 2016
    python benchmarks/study_speed.py FOLDER --config FILE      from mirrors, named under [fetch.rewrite] in FILE
    python benchmarks/study_speed.py FOLDER --distribution FILE

Fetches the list into FOLDER (which is removed first), checks it by the models `paper2016` (with cccc) and `ros` with
process metrics, and writes the study's page; then does the same again. Printed are seconds by the clock and of
processors of each step (children included), the largest resident memory of one process, and the load of the machine.
"""

from __future__ import annotations

import argparse
import os
import resource
import shutil
import subprocess
import sys
import time
from pathlib import Path

LIST = Path(__file__).parent / "corpora" / "study_2015.repos"
BOUND_S = {"cold": 240.0, "again": 10.0}


def step(words: list[str]) -> tuple[float, float, int]:
    """Run `roslens` and return seconds by the clock, of processors, and its exit code."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    done = subprocess.run([sys.executable, "-m", "roslens.cli.main", *words], stdout=subprocess.DEVNULL, check=False)
    took, after = time.monotonic() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
    return took, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.returncode


def main() -> None:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("folder", type=Path)
    arguments.add_argument("--distribution", type=Path, default=LIST)
    arguments.add_argument("--config", type=Path)
    options = arguments.parse_args()
    shutil.rmtree(options.folder, ignore_errors=True)
    options.folder.mkdir(parents=True)
    folder, page = str(options.folder), str(options.folder / "study.html")
    mirrors = ["--config", str(options.config)] if options.config else []
    steps = {
        "fetch": ["fetch", "--distribution", str(options.distribution), "--into", folder, "-q", *mirrors],
        "check": ["check", folder, "--model", "paper2016", "--model", "ros", "--tools", "none", "--process-metrics",
                  "--no-graph", "--fail-on", "never", "-q", "-o", str(options.folder / "report.md")],
        "study": ["study", folder, "--by", "role", "--format", "html", "-o", page],
    }  # fmt: skip
    for turn in ("cold", "again"):
        whole = 0.0
        for name, words in steps.items():
            took, cpu, code = step(words)
            whole += took
            load = os.getloadavg()[0]
            print(
                f"{turn:<6} {name:<6} {took:7.1f} s {cpu:7.1f} s of processors, exit {code}, load {load:.1f}",
                flush=True,
            )
        print(f"{turn:<6} all    {whole:7.1f} s by the clock (bound {BOUND_S[turn]:g} s)", flush=True)
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"largest process: {peak:,.0f} MB")


if __name__ == "__main__":
    main()
