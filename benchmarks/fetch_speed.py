"""How fast repositories are fetched: of mirrors on this machine, so that it is what roslens and git add to a network.

    python benchmarks/fetch_speed.py LIST.repos --config MIRRORS.toml --jobs 1 --jobs 4
    python benchmarks/fetch_speed.py --small 300 --jobs 2        as many small repositories, made for it

Fetches the list into a temporary folder once for each number of jobs, and again, when everything is there. Printed are
seconds by the clock and of processors (children included), repositories a second, and megabytes that came.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import yaml
from measure import folder_size, run


def main() -> int:
    """Measure and print."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("list", type=Path, nargs="?", help="a .repos file")
    arguments.add_argument("--small", type=int, default=0, metavar="N", help="make N repositories of 12 files each")
    arguments.add_argument("--config", type=Path, help="configuration with [fetch.rewrite]")
    arguments.add_argument("--jobs", type=int, action="append", default=[])
    arguments.add_argument("--whole", action="store_true", help="the content of past revisions, too")
    options = arguments.parse_args()
    if bool(options.small) == bool(options.list):
        arguments.error("give a list, or --small N")
    if options.small:
        with tempfile.TemporaryDirectory(prefix="roslens-small-") as folder:
            options.list = made(Path(folder), options.small)
            measure(options)
    else:
        measure(options)
    return 0


def made(folder: Path, many: int) -> Path:
    """Make repositories of a commit of 12 files each, and return the list of them."""
    first = folder / "r0"
    first.mkdir()
    for number in range(12):
        (first / f"file_{number}.txt").write_text("x\n" * 50)
    who = ("-c", "user.name=a", "-c", "user.email=a@example.org")
    for words in (("init", "-q", "-b", "main"), ("add", "-A"), (*who, "commit", "-q", "-m", "first")):
        subprocess.run(["git", "-C", str(first), *words], check=True)
    for number in range(1, many):
        shutil.copytree(first, folder / f"r{number}")
    entries = {
        f"r{number}": {"type": "git", "url": f"file://{folder}/r{number}", "version": "main"} for number in range(many)
    }
    path = folder / "in.repos"
    path.write_text(json.dumps({"repositories": entries}))
    return path


def measure(options: argparse.Namespace) -> None:
    """Fetch a list as the options say, and print what it takes."""
    many = len(yaml.safe_load(options.list.read_text())["repositories"])
    for jobs in options.jobs or [1, 4]:
        with tempfile.TemporaryDirectory(prefix="roslens-fetch-") as folder:
            words = [sys.executable, "-m", "roslens.cli.main", "fetch", "-q", "--distribution", str(options.list),
                     "--into", folder, "--jobs", str(jobs)]  # fmt: skip
            words += ["--config", str(options.config)] if options.config else []
            words += ["--whole"] if options.whole else []
            for title in ("cold", "again"):
                cost = run(words)
                size = folder_size(Path(folder)) / 1e6
                print(
                    f"{jobs} at once, {title:<6} {cost.wall_s:7.1f} s  {cost.cpu_s:6.1f} s of processors  "
                    f"{many / cost.wall_s:6.1f} repositories/s  {size / cost.wall_s:6.1f} MB/s",
                    flush=True,
                )


if __name__ == "__main__":
    sys.exit(main())
