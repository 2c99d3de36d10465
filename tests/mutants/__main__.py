"""``make mutants``: draw mutants, try them, say which survived, and fail where too few of a part were killed."""

from __future__ import annotations

import argparse
import difflib
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

from mutants.mutations import Mutation, mutations
from mutants.parts import LEAST_KILLED, PARTS, Part, asked_about, sources_of

ROOT = Path(__file__).parents[2]


def tell(*lines: str) -> None:
    """Say something at once."""
    sys.stdout.write("\n".join(lines) + "\n")
    sys.stdout.flush()


class Drawn(NamedTuple):
    """A mutant that is to be tried."""

    part: Part
    source: Path
    mutation: Mutation


def main() -> int:
    """Return 0 where enough of each part were killed."""
    parser = argparse.ArgumentParser(prog="python -m mutants", description=__doc__)
    parser.add_argument("part", nargs="*", help=f"of {', '.join(part.name for part in PARTS)} (default: all)")
    parser.add_argument("--each", type=int, default=80, help="mutants of each part (default: 80); 0 for all")
    parser.add_argument("--seed", type=int, default=0, help="of the draw (default: 0)")
    parser.add_argument("--source", default="", help="mutate files alone whose path has this in it")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("-o", "--out", type=Path, default=ROOT / "build" / "mutants.json")
    options = parser.parse_args()
    drawn = _draw(options)
    results: list[dict[str, object]] = []
    with tempfile.TemporaryDirectory(prefix="roslens-mutants-") as folder, ThreadPoolExecutor(options.jobs) as pool:
        workers = [_Worker(Path(folder) / str(number)) for number in range(options.jobs)]
        shares = [drawn[number :: options.jobs] for number in range(options.jobs)]
        for worker_results in pool.map(lambda pair: pair[0].all(pair[1]), zip(workers, shares, strict=True)):
            results += worker_results
    options.out.parent.mkdir(parents=True, exist_ok=True)
    options.out.write_text(json.dumps(results, indent=1))
    return _said(results)


def _draw(options: argparse.Namespace) -> list[Drawn]:
    found = []
    for part in PARTS:
        if options.part and part.name not in options.part:
            continue
        sources = [path for path in sources_of(part, ROOT) if options.source in str(path)]
        every = [Drawn(part, path, one) for path in sources for one in mutations((ROOT / path).read_text("utf-8"))]
        tell(f"{part.name}: {len(every)} mutants of {len(sources)} files")
        if options.each and options.each < len(every):
            every = random.Random(f"{options.seed} {part.name}").sample(every, options.each)
        found += sorted(every, key=lambda one: (str(one.source), one.mutation))
    return found


class _Worker:
    """A copy of the repository, and a process that tries mutants in it."""

    def __init__(self, copy: Path) -> None:
        self._copy = copy
        listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT,
                                capture_output=True, check=True).stdout  # fmt: skip
        for name in filter(None, listed.decode().split("\0")):
            if (ROOT / name).is_file() and not name.startswith("tests/accuracy/"):
                (copy / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, copy / name)
        # A file that changes within a second to one of the same length would not be compiled again otherwise.
        words = ["-m", "compileall", "-q", "--invalidation-mode", "checked-hash", "src/roslens"]
        subprocess.run([sys.executable, *words], cwd=copy, check=False)
        environment = {**os.environ, "ROSLENS_SAME_EXAMPLES": "1", "PYTHONPATH": str(ROOT / "tests"), "CI": ""}
        self._process = subprocess.Popen(
            [sys.executable, "-m", "mutants.server", str(copy)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            text=True, env=environment,
        )  # fmt: skip

    def all(self, drawn: list[Drawn]) -> list[dict[str, object]]:
        """Try mutants one after the other."""
        results, seconds = [], {}
        for one in drawn:
            tests = asked_about(one.part, one.source, self._copy)
            if one.part.name not in seconds:
                said, took = self._try(tests, 600.0)
                if said != "survived":
                    report = self._copy.with_suffix(".txt").read_text("utf-8", "replace")
                    raise SystemExit(f"{one.part.name}: tests fail without a mutant: {said}\n{report[-3000:]}")
                seconds[one.part.name] = 3 * took + 10
            original = (ROOT / one.source).read_text("utf-8")
            (self._copy / one.source).write_text(one.mutation.of(original), "utf-8")
            try:
                said, took = self._try(tests, seconds[one.part.name])
            finally:
                (self._copy / one.source).write_text(original, "utf-8")
            results.append(_result(one, original, said, took))
            tell(f"{said:9} {took:5.1f} s  {one.source}:{one.mutation.line} {one.mutation.kind}")
        self._process.stdin.close()
        self._process.wait()
        return results

    def _try(self, tests: list[str], seconds: float) -> tuple[str, float]:
        begun = time.monotonic()
        self._process.stdin.write(json.dumps([tests, seconds]) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        return json.loads(line) if line else "broken", time.monotonic() - begun


def _result(one: Drawn, original: str, said: str, took: float) -> dict[str, object]:
    lines = difflib.unified_diff(original.splitlines(), one.mutation.of(original).splitlines(), lineterm="", n=0)
    changed = [line for line in lines if line[:1] in "+-" and line[:3] not in ("+++", "---")]
    place = {"source": str(one.source), "line": one.mutation.line, "kind": one.mutation.kind}
    return {"part": one.part.name, **place, "change": changed, "became": said, "seconds": round(took, 1)}


def _said(results: list[dict[str, object]]) -> int:
    for one in results:
        if one["became"] in ("survived", "broken"):
            tell(f"\n{one['became']}: {one['source']}:{one['line']}", *one["change"])
    few = []
    tell(f"\n{'part':8} {'drawn':>6} {'killed':>7} {'endless':>8} {'survived':>9} {'share':>7}")
    for part in dict.fromkeys(str(one["part"]) for one in results):
        counts = Counter(str(one["became"]) for one in results if one["part"] == part)
        drawn, killed = counts.total(), counts["killed"] + counts["endless"]
        row = f"{counts['killed']:7} {counts['endless']:8} {counts['survived'] + counts['broken']:9}"
        tell(f"{part:8} {drawn:6} {row} {killed / drawn:7.0%}")
        few += [part] if killed < LEAST_KILLED * drawn else []
    if few:
        tell("", f"fewer than {LEAST_KILLED:.0%} were killed of {', '.join(few)}: write tests that look there")
    return bool(few)


if __name__ == "__main__":
    sys.exit(main())
