"""Measures checkouts and writes the page: ``python -m endpoint_sites CLONES docs/endpoint_sites.md [LABELLED]``.

CLONES is a folder with clones of any repositories, LABELLED one with those of ``tests/fixtures/extract``.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from endpoint_sites.measuring import REPOSITORIES, found_by_command, measured, rows_of
from endpoint_sites.of_command import asked, checkouts, commit_of, told_of
from endpoint_sites.page import page


def main() -> int:
    """Measure the repositories below a folder, and the labelled ones where their folder is given."""
    parser = argparse.ArgumentParser(prog="endpoint_sites", description=__doc__)
    parser.add_argument("clones", type=Path)
    parser.add_argument("target", type=Path)
    parser.add_argument("labelled", type=Path, nargs="?")
    parser.add_argument("--tuned", action="store_true", help="say that roslens was developed on these clones")
    parser.add_argument("-v", action="store_true", help="print the calls that are lost")
    options = parser.parse_args()
    told = {}
    for name, root in checkouts(options.clones):
        one = told[name] = told_of(root)
        counts = f"{one.calls} calls, {one.shown} shown, {one.named} named, {len(one.lost)} lost"
        lost = [f"    {call.path}:{call.line}: {call.text[:120]}" for call in one.lost] if options.v else []
        sys.stdout.write("\n".join((f"{name} {one.commit}: {counts}", *lost, "")))
        sys.stdout.flush()
    labelled = {}
    for name in REPOSITORIES if options.labelled else ():
        root = options.labelled / name
        if not root.is_dir():
            sys.stderr.write(f"{root} is not there: its table is left out\n")
            continue
        labelled[name] = (commit_of(root), measured(rows_of(name), found_by_command(asked(root))))
    options.target.write_text(page(told, labelled, tuned=options.tuned), "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
