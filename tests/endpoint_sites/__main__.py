"""Measures checkouts and writes the page: ``python -m endpoint_sites CORPUS docs/endpoint_sites.md``."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from endpoint_sites.measuring import REPOSITORIES, found_below, measured, rows_of
from endpoint_sites.page import page


def main() -> int:
    """Measure the repositories below a folder that are there."""
    corpus, target = Path(sys.argv[1]), Path(sys.argv[2])
    results = {}
    for name in REPOSITORIES:
        root = corpus / name
        if not root.is_dir():
            sys.stderr.write(f"{root} is not there: no page was written\n")
            return 2
        command = ["git", "-C", str(root), "rev-parse", "--short=7", "HEAD"]
        commit = subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()
        results[name] = (commit, measured(rows_of(name), found_below(root)))
    target.write_text(page(results), "utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
