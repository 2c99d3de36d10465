"""Pair two revisions: a command with one and with the other, in turn, so that a drifting machine drifts for both.

    python benchmarks/paired.py BASE CORPUS [--rounds 7] [--what check graph]

BASE is a revision of git; the other side is the working tree. Each round runs ``roslens check`` without anything kept,
and the facts of all nodes (``graph``), with one job. The ratio is the working tree's CPU seconds by those of BASE.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from measure import in_turn, ratio

ROOT = Path(__file__).parents[1]
MAIN = "import sys; from roslens.cli.main import main; sys.exit(main(sys.argv[1:]))"
FACTS = """
import sys, time
from pathlib import Path
from roslens.source.extract.workspace.extraction import extract
from roslens.source.settings import SourceSettings
from roslens.store.cache import Cache
with Cache.open(None) as cache:
    extract([Path(sys.argv[1])], SourceSettings(), cache=cache, now_s=time.time(), jobs=1)
"""


def laid_out(revision: str, target: Path) -> Path:
    """Write the source of a revision below a folder; return what is put into ``PYTHONPATH``."""
    command = ["git", "-C", str(ROOT), "archive", revision, "src/roslens"]
    packed = subprocess.run(command, check=True, capture_output=True).stdout
    subprocess.run(["tar", "-x", "-C", str(target)], input=packed, check=True)
    return target / "src"


def main() -> int:
    """Print a row for each command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("base")
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--what", nargs="+", choices=("check", "graph"), default=["check", "graph"])
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        before, root = Path(folder, "before"), Path(folder, "corpus")
        before.mkdir()
        sides = {"base": laid_out(options.base, before), "now": ROOT / "src"}
        shutil.copytree(options.corpus, root, symlinks=True, ignore=shutil.ignore_patterns(".git", ".roslens"))
        checked = [MAIN, "check", str(root), "--jobs", "1", "-q", "--fail-on", "never"]
        words = {"check": checked, "graph": [FACTS, str(root)]}
        print("| command | by the revision before | least | most | pairs |\n| --- | --- | --- | --- | --- |")
        for what in options.what:
            commands = {
                side: ["env", f"PYTHONPATH={source}", sys.executable, "-c", *words[what]]
                for side, source in sides.items()
            }
            forget = {side: lambda: shutil.rmtree(root / ".roslens", ignore_errors=True) for side in sides}
            in_turn(commands, 1, forget)
            costs = in_turn(commands, options.rounds, forget)
            each = [now.cpu_s / base.cpu_s for now, base in zip(costs["now"], costs["base"], strict=True)]
            middle = ratio(costs, "now", "base")
            print(f"| {what} | {middle:.3f} | {min(each):.3f} | {max(each):.3f} | {len(each)} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
