"""``python -m shapes SIZE…``: read every shape at these sizes, and write what that took to ``docs/worst_shapes.md``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from shapes.readers import READERS, Measured, ReadError, measured, ready
from shapes.shapes import SHAPES

PAGE = Path(__file__).parents[2] / "docs" / "worst_shapes.md"
_HEAD = """\
# Worst shapes

Files made to be expensive: deep nesting, long lists, long words, huge numbers, things that are never closed, each
from a generator (`tests/shapes/shapes.py`), read as a check and a graph read them, with the budget of a file
([SECURITY.md](../SECURITY.md)). `PYTHONPATH=tests python -m shapes SIZE…` writes this page;
`tests/shapes/test_shapes.py` reads the small ones in every run of the tests. Processor time and memory are those of the
process that reads, with what it takes to start (30 MB); times differ between machines.

| grammar | bytes | shapes | left out | most time | for | most memory | for |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""


def main() -> int:
    """Return 0 if every shape was read or left out."""
    parser = argparse.ArgumentParser(prog="python -m shapes", description=__doc__)
    parser.add_argument("sizes", nargs="+", type=int, metavar="SIZE", help="in bytes")
    parser.add_argument("--grammar", action="append", help=f"of {', '.join(READERS)} (default: all)")
    options = parser.parse_args()
    rows, wrong = [], 0
    for grammar in options.grammar or READERS:
        ready(grammar)
        for size in options.sizes:
            found: dict[str, Measured] = {}
            for name, shape in SHAPES[grammar].items():
                try:
                    found[name] = measured(grammar, shape(size))
                except ReadError as error:
                    wrong += 1
                    sys.stdout.write(f"{grammar}, {name}, {size}: {error}\n")
            rows.append(_row(grammar, size, found))
            sys.stdout.write(rows[-1])
            sys.stdout.flush()
    if not options.grammar:
        PAGE.write_text(_HEAD + "".join(rows))
    return bool(wrong)


def _row(grammar: str, size: int, found: dict[str, Measured]) -> str:
    slowest, largest = (max(found, key=lambda name: found[name][place]) for place in (0, 1))
    left_out = sum(bool(one.left_out) for one in found.values())
    return (
        f"| {grammar} | {size:,} | {len(found)} | {left_out} | {found[slowest].seconds:.1f} s | {slowest} "
        f"| {found[largest].megabytes:,.0f} MB | {largest} |\n"
    )


if __name__ == "__main__":
    sys.exit(main())
