"""Measures how much of what is planted is found: ``python -m planted FOLDER… --seed N`` writes the page."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from planted.measuring import default_rules, measure
from planted.page import PAGE, page
from planted.variants import VARIANTS


def main() -> int:
    """Do what the command line asks for."""
    parser = argparse.ArgumentParser(prog="python -m planted", description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path, help="with real source to plant into")
    parser.add_argument("--seed", type=int, default=7, help="of the choice of files and places (default: 7)")
    parser.add_argument("--rules", nargs="+", default=[], metavar="ID", help="these only; the page is not written")
    parser.add_argument("--variants", type=int, default=VARIANTS, metavar="N", help="of each rule; the page has all")
    options = parser.parse_args()
    missing = [str(one) for one in options.folders if not one.is_dir()]
    rules = [one for one in default_rules() if not options.rules or one.id in options.rules]
    if missing or not rules:
        sys.stderr.write(
            f"no such folder: {', '.join(missing)}\n" if missing else "no rule on by default has this id\n"
        )
        return 2
    counts = measure(rules, options.folders, options.seed, range(options.variants))
    for rule, one in counts.items():
        if one.found < one.planted:
            sys.stdout.write(f"{rule}: {one.found} of {one.planted}, not variant {', '.join(map(str, one.missed))}\n")
    if not options.rules and options.variants == VARIANTS:
        PAGE.write_text(page(counts, [_named(one) for one in options.folders], options.seed), "utf-8")
        sys.stdout.write(f"{PAGE}\n")
    return 0


def _named(folder: Path) -> str:
    return f"`{folder.name.replace('+', '/', 1)}`"


if __name__ == "__main__":
    sys.exit(main())
