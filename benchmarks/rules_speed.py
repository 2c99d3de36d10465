"""What the native rules cost on top of metrics, and what cpplint takes for the same files.

    python benchmarks/rules_speed.py CORPUS [--cpplint COMMAND] [--rounds N]

CORPUS is a folder with clones, as for ``source_speed.py``; their C and C++ files are copied to a temporary folder.
There run in turn: a bare tree-sitter parse, the facts that metrics are made of, the same with the native rules that
are on by default and with all of them, ``roslens check`` of all of it without a cache, with the rules that are on by
default and with all that can be on together, and cpplint. CPU seconds are of whole processes, children included.
"""

from __future__ import annotations

import argparse
import shlex
import sys
import tempfile
from pathlib import Path

from measure import in_turn, middle, ratio
from source_speed import BARE, copied

FACTS = """
import gc, sys
from pathlib import Path
from roslens.intake.bounded_file import read_bounded
from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.settings import MacroSettings
from roslens.source.metrics.measure_file import measure_file
from roslens.source.settings import CountingSettings
from roslens.source.settings import RuleSettings
if {rules}:
    from roslens.source.rules.callbacks import callbacks_of
    from roslens.source.rules.match_file import kinds_asked, match_file
    from roslens.source.rules.selection import wanted_rules
    from roslens.source.rules.table import native_rules
    wanted = wanted_rules(RuleSettings(), native_rules()) if {rules} == 1 else None
kinds = kinds_asked("cpp", wanted) if {rules} else frozenset()
gc.disable()
macros, counting = MacroSettings(), CountingSettings()
for line in Path(sys.argv[1]).read_text().splitlines():
    parsed = parse_file(read_bounded(line), Language.CPP, macros)
    measure_file(line, parsed.facts(kinds), counting)
    if {rules}:
        view = parsed.view()
        match_file(view, wanted)
        callbacks_of(view)
"""


UNKEPT = ("--fail-on", "never", "--no-store", "--no-cache")


def _unlike() -> set[str]:
    """Return the rules that must be off for all others to be on: one of each two that require opposites."""
    from roslens.source.rules.table import native_rules

    return {max(one, other) for one, rule in native_rules().items() for other in rule.unlike}


def main() -> int:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("corpus", type=Path)
    arguments.add_argument("--cpplint", default="", help="command that starts cpplint, e.g. 'python -m cpplint'")
    arguments.add_argument("--rounds", type=int, default=3)
    options = arguments.parse_args()
    with tempfile.TemporaryDirectory(prefix="roslens-bench-") as scratch:
        root = Path(scratch, "ws")
        files = copied(options.corpus, root)
        listing = Path(scratch, "files.txt")
        listing.write_text("\n".join(map(str, files)))
        every = Path(scratch, "every.toml")
        every.write_text(f'[rules]\nenable = ["*"]\ndisable = {sorted(_unlike())}\n')
        check = [str(Path(sys.executable).with_name("roslens")), "check", str(root), "--jobs", "1", "-q"]
        commands = {
            "bare parse": [sys.executable, "-c", BARE, str(listing)],
            "metrics alone": [sys.executable, "-c", FACTS.format(rules=0), str(listing)],
            "metrics and default rules": [sys.executable, "-c", FACTS.format(rules=1), str(listing)],
            "metrics and all rules": [sys.executable, "-c", FACTS.format(rules=2), str(listing)],
            "roslens check": [*check, *UNKEPT],
            "roslens check, all rules": [*check, *UNKEPT, "--config", str(every)],
        }
        if options.cpplint:
            commands["cpplint"] = [*shlex.split(options.cpplint), "--quiet", *map(str, files)]
        in_turn({"bare parse": commands["bare parse"]}, 1, {})
        costs = in_turn(commands, options.rounds, {})
        lines = sum(file.read_bytes().count(b"\n") for file in files)
    print(f"{len(files)} files, {lines} lines; medians of {options.rounds} rounds\n")
    print("| run | CPU s | peak MB | by bare parse | by metrics alone | cpplint takes |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name, runs in costs.items():
        cpu, peak = (middle([cost[index] for cost in runs]) for index in (0, 2))
        shares = " | ".join(f"{ratio(costs, name, peer):.2f}" for peer in ("bare parse", "metrics alone"))
        times = f"{ratio(costs, 'cpplint', name):.1f}" if options.cpplint else "-"
        print(f"| {name} | {cpu:.2f} | {peak:.0f} | {shares} | {times} |")
    return 0


if __name__ == "__main__":
    sys.exit(main())
