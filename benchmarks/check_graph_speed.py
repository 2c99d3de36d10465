"""What looking at computation graphs costs in ``roslens check``: the figures of docs/costs.md.

    python benchmarks/check_graph_speed.py WORKSPACE… [--rounds N]

Of each workspace the files are copied to two temporary folders, one for checks with graphs and one for their peer,
checks without. In each round there run in turn, each as a whole process with its children: a cold check, the same
without a cache, and a check after each of these edits: none; a comment at the end of the largest source; a line at its
top, which moves all others; one at the end of the largest file of parameters, and of the largest launch file in Python.
CPU seconds are the least of the rounds; a ratio is the median of those of the rounds. Last, a cold check with graphs
runs while the memory of its processes is looked at ten times a second: the largest resident set of one, and the largest
sum of what all have, shared pages divided among them (PSS).
"""

from __future__ import annotations

import argparse
import shutil
import statistics
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from measure import peak_memory, run

RACY_S = 2.1
"""Files that changed less long ago are read again; see ``roslens.store.cache``."""


class Edit(NamedTuple):
    """An edit: what it is called, and what makes it in a copy of the workspace with a number, so that each differs."""

    name: str
    make: Callable[[Path, int], object]


def command(root: Path, *options: str) -> list[str]:
    """Return a check as a command."""
    roslens = str(Path(sys.executable).with_name("roslens"))
    return [roslens, "check", str(root), "-q", "--fail-on", "never", *options]


def cold(root: Path, *options: str) -> float:
    """Return the CPU seconds of a check that knows nothing of the workspace."""
    shutil.rmtree(root / ".roslens", ignore_errors=True)
    return run(command(root, *options)).cpu_s


def largest(root: Path, patterns: tuple[str, ...], word: bytes = b"") -> str | None:
    """Return the path of the largest file that fits one of the patterns and has a word in it."""
    found = {path for pattern in patterns for path in root.rglob(pattern) if "test" not in path.as_posix()}
    fit = sorted(path for path in found if word in path.read_bytes())
    place = max(fit, key=lambda path: path.stat().st_size, default=None)
    return None if place is None else place.relative_to(root).as_posix()


def edits(root: Path) -> list[Edit]:
    """Return the edits that there are files for."""
    found = [Edit("nothing", lambda _root, _number: None)]
    source = largest(root, ("*.cpp",)) or largest(root, ("*.py",), b"rclpy") or largest(root, ("*.py",), b"rospy")
    if source is not None:
        comment = "//" if source.endswith(".cpp") else "#"
        place = source
        found += [
            Edit("a comment", lambda root, number: append(root / place, f"\n{comment} changed {number}\n")),
            Edit("a line at the top", lambda root, number: prepend(root / place, f"{comment} changed {number}\n")),
        ]
    parameters = largest(root, ("*.yaml",), b"ros__parameters")
    launch = largest(root, ("*launch.py",))
    for name, path in (("parameters", parameters), ("a launch file", launch)):
        if path is not None:
            found.append(Edit(name, _commented(path)))
    return found


def _commented(path: str) -> Callable[[Path, int], object]:
    """Return an edit that adds a comment at the end of a file."""
    return lambda root, number: append(root / path, f"\n# changed {number}\n")


def append(path: Path, text: str) -> None:
    """Add text at the end of a file."""
    with path.open("a") as file:
        file.write(text)


def prepend(path: Path, text: str) -> None:
    """Add text at the beginning of a file."""
    path.write_bytes(text.encode() + path.read_bytes())


def row(name: str, pairs: list[tuple[float, float]]) -> None:
    """Print the CPU seconds with and without graphs, and the ratio."""
    ratio = statistics.median(graph / plain for graph, plain in pairs)
    graph, plain = (min(pair[place] for pair in pairs) for place in (0, 1))
    print(f"| {name} | {graph:.2f} | {plain:.2f} | {ratio:.2f} |", flush=True)


def measured(workspace: Path, root: Path, peer: Path, rounds: int) -> None:
    """Measure a workspace and print a table."""
    packages = sum(1 for _ in root.rglob("package.xml"))
    print(f"\n{workspace.name}, {packages} packages\n")
    print("| check | CPU s | CPU s with `--no-graph` | ratio |")
    print("| --- | ---: | ---: | ---: |")
    row("cold", [(cold(root), cold(peer, "--no-graph")) for _ in range(rounds)])
    uncached = [(cold(root, "--no-cache"), cold(peer, "--no-cache", "--no-graph")) for _ in range(rounds)]
    row("cold, `--no-cache`", uncached)
    cold(root)
    cold(peer, "--no-graph")
    for edit in edits(root):
        pairs = []
        for number in range(rounds):
            time.sleep(RACY_S)
            run(command(root))
            run(command(peer, "--no-graph"))
            edit.make(root, number)
            edit.make(peer, number)
            pairs.append((run(command(root)).cpu_s, run(command(peer, "--no-graph")).cpu_s))
        row(f"again, {edit.name} changed", pairs)
    shutil.rmtree(root / ".roslens", ignore_errors=True)
    one, all_together = peak_memory(command(root))
    print(f"\npeak of a cold check: {one:.0f} MB in one process, {all_together:.0f} MB in all together")


def main() -> int:
    """Measure and print a table for each workspace."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("workspaces", type=Path, nargs="+")
    arguments.add_argument("--rounds", type=int, default=3)
    options = arguments.parse_args()
    for workspace in options.workspaces:
        with tempfile.TemporaryDirectory(prefix="roslens-bench-") as scratch:
            root, peer = Path(scratch, workspace.name), Path(scratch, "peer")
            for place in (root, peer):
                shutil.copytree(workspace, place, ignore=shutil.ignore_patterns(".git", ".roslens"))
            measured(workspace, root, peer, options.rounds)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
