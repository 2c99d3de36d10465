"""The process that is forked for each mutant: it has imported what tests need, and nothing of roslens."""

from __future__ import annotations

import json
import sys
import warnings
from pathlib import Path

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    import httpx  # noqa: F401
    import hypothesis.strategies  # noqa: F401
    import jinja2  # noqa: F401
    import msgspec  # noqa: F401
    import numpy  # noqa: F401, ICN001
    import starlette.applications  # noqa: F401
    import yaml  # noqa: F401

from mutants.trial import tried


def main() -> None:
    """Read ``[tests, seconds]`` from each line, and say what became of the mutant."""
    copy = Path(sys.argv[1])
    if any(name.partition(".")[0] == "roslens" for name in sys.modules):
        raise SystemExit("roslens was imported before the mutant was there")
    for line in sys.stdin:
        tests, seconds = json.loads(line)
        said = tried(copy, tests, seconds, copy.parent / f"{copy.name}.txt")
        sys.stdout.write(json.dumps(said) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
