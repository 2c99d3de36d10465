"""The figures of docs/costs.md on the speed of `roslens check`.

    python benchmarks/source_speed.py CORPUS

CORPUS is a folder with clones; its figures are of ros_comm 845f746, navigation 9ad6441 and
navigation2 a3a9704. Their C and C++ files and manifests are copied to a temporary folder; there run in
turn: a bare tree-sitter parse of the same files, lizard, `roslens check` cold, warm, and after a change
of one file. CPU seconds are of whole processes, children included.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

from measure import in_turn, middle, ratio

SUFFIXES = (".h", ".hpp", ".hh", ".hxx", ".c", ".cc", ".cpp", ".cxx")

BARE = """
import gc, sys
from pathlib import Path
import tree_sitter, tree_sitter_cpp
gc.disable()
parser = tree_sitter.Parser(tree_sitter.Language(tree_sitter_cpp.language()))
for line in Path(sys.argv[1]).read_text().splitlines():
    with open(line, "rb") as file:
        parser.parse(file.read())
"""


def copied(corpus: Path, target: Path) -> list[Path]:
    """Copy manifests and C and C++ files; return the latter."""
    files = []
    for path in sorted(corpus.rglob("*")):
        if ".git" in path.parts or path.is_symlink() or not path.is_file():
            continue
        if path.suffix in SUFFIXES or path.name == "package.xml":
            place = target / path.relative_to(corpus)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, place)
            if path.suffix in SUFFIXES:
                files.append(place)
    return files


def main() -> int:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("corpus", type=Path)
    arguments.add_argument("--rounds", type=int, default=3)
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory(prefix="roslens-bench-") as scratch:
        root = Path(scratch, "ws")
        files = copied(options.corpus, root)
        listing = Path(scratch, "files.txt")
        listing.write_text("\n".join(map(str, files)))
        victim = max((file for file in files if file.suffix == ".cpp"), key=lambda file: file.stat().st_size)
        roslens = [str(Path(sys.executable).with_name("roslens")), "check", str(root), "--jobs", "1", "-q"]
        roslens += ["--fail-on", "never"]
        commands = {
            "bare parse": [sys.executable, "-c", BARE, str(listing)],
            "lizard": [sys.executable, "-m", "lizard", "-l", "cpp", "--csv", "-f", str(listing)],
            "cold": roslens,
            "warm": roslens,
            "one file changed": roslens,
            "help": [roslens[0], "--help"],
        }

        def forget() -> None:
            shutil.rmtree(root / ".roslens", ignore_errors=True)

        def touch() -> None:
            with victim.open("a") as file:
                file.write(f"\n// changed {os.urandom(4).hex()}\n")

        def let_time_pass() -> None:
            # Time stamps younger than two seconds are not trusted, and rightly so.
            import time

            time.sleep(2.5)

        before = {"cold": forget, "warm": let_time_pass, "one file changed": touch}
        in_turn({"bare parse": commands["bare parse"]}, 1, {})
        costs = in_turn(commands, options.rounds, before)
        lines = sum(file.read_bytes().count(b"\n") for file in files)
    print(f"{len(files)} files, {lines} lines; medians of {options.rounds} rounds\n")
    print("| run | CPU s | wall s | peak MB | by bare parse | by lizard |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name, runs in costs.items():
        cpu, wall, peak = (middle([cost[index] for cost in runs]) for index in range(3))
        shares = " | ".join(f"{ratio(costs, name, peer):.2f}" for peer in ("bare parse", "lizard"))
        print(f"| {name} | {cpu:.2f} | {wall:.2f} | {peak:.0f} | {shares} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
