"""``python -m fuzz KIND…``: try cases, and keep what fails in ``tests/fixtures/fuzz``."""

from __future__ import annotations

import argparse
import sys
from functools import partial

from pace import slowness

from fuzz.kinds import KINDS, Kind
from fuzz.runner import LONGEST_S, keep, run, shrunk, why_it_fails


def main() -> int:
    """Return 0 where every case was answered."""
    parser = argparse.ArgumentParser(prog="python -m fuzz", description=__doc__)
    parser.add_argument("kinds", nargs="*", help=f"of {', '.join(KINDS)} (default: all)")
    parser.add_argument("--cases", type=int, help="of each kind (default: as many as fit)")
    parser.add_argument("--minutes", type=float, default=1.0, help="for each kind (default: 1)")
    parser.add_argument("--seed", type=int, default=0, help="of the first case (default: 0)")
    options = parser.parse_args()
    wrong = 0
    for name in options.kinds or KINDS:
        done, failed = run(name, options.seed, options.cases, 1e9 if options.cases else options.minutes * 60)
        sys.stdout.write(f"{name}: {done:,} cases, {len(failed)} not answered\n")
        seen = set()
        for one in failed:
            wrong += 1
            reason = one.why.strip().rpartition("\n")[2]
            if reason in seen:
                continue
            seen.add(reason)
            content = one.content
            if "ended by" not in one.why and "more than" not in reason:
                longest_s = LONGEST_S * slowness()
                content = shrunk(content, partial(_same, KINDS[name], longest_s, reason))
            sys.stdout.write(f"{keep(name, content)}\n{one.why}\n")
        sys.stdout.flush()
    return bool(wrong)


def _same(kind: Kind, longest_s: float, reason: str, content: bytes) -> bool:
    said = why_it_fails(kind, content, longest_s).strip().rpartition("\n")[2]
    return said.partition(":")[0] == reason.partition(":")[0] != ""


if __name__ == "__main__":
    sys.exit(main())
