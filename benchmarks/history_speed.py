"""What past revisions cost, and process metrics on top of a check.

    python benchmarks/history_speed.py CLONE [--revisions N] [--rounds N]

CLONE is a work tree of a repository with all its commits; it is cloned to a temporary folder. ``roslens history
--every 1`` analyses its last N revisions of the main line, once cold and once more; reported are how long each took (as
kept with its run), processor seconds, and what is kept. Then ``roslens check`` runs without and with
``--process-metrics`` in turn, each time without a cache; the ratio of their processor seconds is what these cost.
"""

from __future__ import annotations

import argparse
import os
import sqlite3
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median, quantiles

ROSLENS = [sys.executable, "-m", "roslens.cli.main"]


def run(words: list[str], folder: Path) -> tuple[float, float]:
    """Return seconds by the clock and of processors, children included."""
    before, begun = os.times(), time.monotonic()
    done = subprocess.run([*ROSLENS, *words], cwd=folder, capture_output=True, text=True, check=False)
    after = os.times()
    if done.returncode not in (0, 1, 3):
        raise SystemExit(f"roslens {' '.join(words)}: {done.returncode}\n{done.stderr}")
    spent = after.children_user + after.children_system - before.children_user - before.children_system
    return time.monotonic() - begun, spent


def git(folder: Path, *words: str) -> str:
    """Return what git says."""
    return subprocess.run(["git", "-C", str(folder), *words], check=True, capture_output=True, text=True).stdout.strip()


def main() -> int:
    """Measure and print."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("clone", type=Path)
    arguments.add_argument("--revisions", type=int, default=1000)
    arguments.add_argument("--rounds", type=int, default=3)
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory(prefix="roslens-bench-") as scratch:
        folder = Path(scratch, "clone")
        git(options.clone, "clone", "-q", "--shared", "--no-checkout", str(options.clone.resolve()), str(folder))
        # A mirror may be without its largest files, pictures say: the work tree is too, then.
        subprocess.run(["git", "-C", str(folder), "checkout", "-q", "-f", "HEAD"], capture_output=True, check=False)
        line = git(folder, "rev-list", "--first-parent", f"--max-count={options.revisions}", "HEAD").splitlines()
        # By its commit: dates do not rise along the line.
        wall, spent = run(["history", "--every", "1", "--since", line[-1], "-q"], folder)
        with sqlite3.connect(folder / ".roslens/history.sqlite") as kept:
            took = sorted(row[0] for row in kept.execute("SELECT seconds FROM run"))
        size = (folder / ".roslens/history.sqlite").stat().st_size
        tenths = quantiles(took, n=10)
        per, megabytes = spent / len(took), size / len(took) / 1e6
        print(f"{options.clone.name}: {len(took)} revisions in {wall:.0f} s, {spent:.0f} s of processors", flush=True)
        print(
            f"  a revision: median {median(took):.2f} s, 90 % at most {tenths[-1]:.2f} s; in the mean {per:.2f} s of a"
        )
        print(f"  processor and {megabytes:.2f} MB", flush=True)
        wall, spent = run(["history", "--every", "1", "--since", line[-1], "-q"], folder)
        print(f"  once more: {wall:.1f} s, {spent:.1f} s of a processor")
        plain: list[float] = []
        with_process: list[float] = []
        for _ in range(options.rounds):
            for more, found in (([], plain), (["--process-metrics"], with_process)):
                words = ["check", "--no-cache", "--no-store", "--jobs", "1", "-q", "--fail-on", "never", *more]
                found.append(run(words, folder)[1])
        ratio = median(with_process) / median(plain)
        print(f"  check: {median(plain):.2f} s of a processor, with process metrics {ratio:.2f} times that")
    return 0


if __name__ == "__main__":
    sys.exit(main())
