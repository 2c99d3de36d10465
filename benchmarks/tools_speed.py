"""What `roslens check` with tools on takes, beside the same tools run once each by hand.

    python benchmarks/tools_speed.py CORPUS [--tools ruff,cppcheck,cpplint] [--rounds N]

CORPUS is a folder with clones; their C, C++ and Python files and manifests are copied to a temporary folder. There
run in turn: each tool once, on all files of its languages and with the options that roslens gives it, `roslens check`
with none of them, and with all of them. Nothing is cached, and one process works at a time. CPU seconds are of whole
processes, children included. By hand the tools see every file, roslens gives them own code and tests alone.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

from measure import in_turn, middle
from source_speed import SUFFIXES

UNKEPT = ("--fail-on", "never", "--no-store", "--no-cache")
C_LIKE = frozenset(SUFFIXES)


def copied(corpus: Path, target: Path) -> list[str]:
    """Copy manifests, C, C++ and Python files; return the paths of the latter three below ``target``."""
    files = []
    for path in sorted(corpus.rglob("*")):
        if ".git" in path.parts or path.is_symlink() or not path.is_file():
            continue
        if path.suffix in C_LIKE | {".py"} or path.name == "package.xml":
            place = target / path.relative_to(corpus)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, place)
            if path.name != "package.xml":
                files.append(f"./{place.relative_to(target)}")
    return files


def by_hand(name: str, root: Path, files: list[str], scratch: Path) -> list[str]:
    """Return the one call of a tool on all files of its languages."""
    from roslens.source.tools.running.programs import find_program
    from roslens.source.tools.table import tool_named
    from roslens.source.tools.tool import Request

    tool, program = tool_named(name), find_program(name, str(root))
    if program is None:
        raise SystemExit(f"{name} is not installed; {tool.get}")
    mine = [one for one in files if (Path(one).suffix in C_LIKE) == ("cpp" in tool.languages)]
    scratch.mkdir()
    options = {option.name: option.default for option in tool.options}
    request = Request(program.path, str(root), tuple(mine), options, str(scratch), group="cpp")
    # Some say in their exit code what they found, pylint in all of its bits.
    return ["sh", "-c", 'cd "$1" && shift && "$@"; exit 0', "sh", str(root), *tool.words(request)]


def main() -> int:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("corpus", type=Path)
    arguments.add_argument("--tools", default="ruff,cppcheck,cpplint", help="names, with commas between")
    arguments.add_argument("--rounds", type=int, default=3)
    options = arguments.parse_args()
    names = options.tools.split(",")
    with tempfile.TemporaryDirectory(prefix="roslens-bench-") as scratch:
        root = Path(scratch, "ws")
        files = copied(options.corpus, root)
        check = [str(Path(sys.executable).with_name("roslens")), "check", str(root), "--jobs", "1", "-q", *UNKEPT]
        commands = {name: by_hand(name, root, files, Path(scratch, name)) for name in names}
        commands |= {"roslens check": check, "roslens check with them": [*check, "--tools", options.tools]}
        costs = in_turn(commands, options.rounds, {})
    print(f"{len(files)} files; medians of {options.rounds} rounds\n")
    print("| run | CPU s |")
    print("| --- | --- |")
    for name, runs in costs.items():
        print(f"| {name} | {middle([cost.cpu_s for cost in runs]):.2f} |")
    rounds = range(options.rounds)
    sums = [sum(costs[name][number].cpu_s for name in names) for number in rounds]
    shares = [costs["roslens check with them"][number].cpu_s / sums[number] for number in rounds]
    print(f"\nroslens check with them by all of them once by hand: {middle(shares):.2f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
