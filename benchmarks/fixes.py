"""What ``roslens check --fix`` does to public code: how much it mends, and whether what parsed and compiled still does.

    python benchmarks/fixes.py CLONE… [--include FOLDER]… [--compile N] [--sample FILE --seed N]

Each clone is copied, and every rule with a fix is on. Reported are the findings that were mended by rule, places that
do not parse afterwards and did before, what a second ``--fix`` changes, and, of up to N sources of each clone that were
changed or include what was, how many ``g++ -fsyntax-only`` takes before and after; headers are looked for below the
include folders of the clone and in each FOLDER (``--quote``: for names in quotes only). ``--sample`` writes 40 hunks of
the diffs, drawn by the seed, for somebody to read. ``--as-is`` takes the rules that are on by default instead of all.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from roslens.source.rules.table import native_rules

OPPOSITE = ("cpp.missing_virtual",)
"""Rules that require the opposite of another one that is on."""
SAMPLE = 40


def main() -> int:
    """Measure and print a table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("clones", type=Path, nargs="+")
    arguments.add_argument("--include", type=Path, action="append", default=[])
    arguments.add_argument("--quote", type=Path, action="append", default=[])
    arguments.add_argument("--compile", type=int, default=0)
    arguments.add_argument("--sample", type=Path)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--as-is", action="store_true")
    options = arguments.parse_args()
    hunks: list[str] = []
    rules: Counter[str] = Counter()
    print("| repository | fixed | files | left | new faults | second fix | compiled before | after |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for clone in options.clones:
        with tempfile.TemporaryDirectory(prefix="roslens-fixes-") as scratch:
            row = measured(clone.resolve(), Path(scratch), options)
        rules += row["rules"]
        hunks += row["hunks"]
        print(
            f"| {clone.name.replace('+', '/')} | {row['fixed']} | {row['files']} | {row['left']} | {row['faults']} "
            f"| {row['again']} | {row['before']} | {row['after']} |",
            flush=True,
        )
        for line in row["broken"]:
            print(f"    {line}", file=sys.stderr, flush=True)
    print()
    for rule, number in rules.most_common():
        print(f"| `{rule}` | {number} |")
    if options.sample:
        drawn = random.Random(options.seed).sample(hunks, min(SAMPLE, len(hunks)))
        options.sample.write_text("\n".join(drawn), errors="replace")
    return 0


def measured(clone: Path, scratch: Path, options: argparse.Namespace) -> dict[str, Any]:
    """Return what is reported of one clone."""
    root, before = scratch / "after" / clone.name, scratch / "before" / clone.name
    for place in (root, before):
        shutil.copytree(clone, place, symlinks=True, ignore=shutil.ignore_patterns(".git", ".roslens"))
    config = scratch / "roslens.toml"
    ids = [] if options.as_is else [one.id for one in native_rules().values() if one.fix and one.id not in OPPOSITE]
    config.write_text(f"[rules]\nenable = {json.dumps(ids)}\n")
    first = report(root, config)
    fixed = check(root, config, "--fix", "-o", str(scratch / "after.json"))
    said = re.search(r"fixed (\d+) of (\d+) findings? with a fix in (\d+) files?", fixed.stderr)
    numbers = [int(one) for one in said.groups()] if said else [0, 0, 0]
    after = json.loads((scratch / "after.json").read_text())
    again = check(root, config, "--diff")
    difference = subprocess.run(
        ["git", "diff", "--no-index", "--no-color", "-U3", "before", "after"],
        cwd=scratch,
        capture_output=True,
        check=False,
    ).stdout.decode(errors="replace")
    ok, kept, broken = compiled(before, root, options)
    return {
        "fixed": numbers[0],
        "left": numbers[1] - numbers[0],
        "files": numbers[2],
        "faults": max(0, faults(after) - faults(first)),
        "again": again.stdout.count("\n@@ "),
        "rules": Counter(one["rule"] for one in first["findings"] if one["gated"] and "fix" in one) - Counter(),
        "hunks": list(hunks_of(difference, clone.name)),
        "before": ok,
        "after": kept,
        "broken": broken,
    }


def check(root: Path, config: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run ``roslens check``."""
    command = [sys.executable, "-m", "roslens.cli.main", "check", str(root), "--config", str(config), *words]
    return subprocess.run(
        [*command, "--fail-on", "never"], capture_output=True, text=True, errors="replace", check=False
    )


def report(root: Path, config: Path) -> dict[str, Any]:
    """Return the JSON report."""
    document: dict[str, Any] = json.loads(check(root, config, "--format", "json").stdout)
    return document


def faults(document: dict[str, Any]) -> int:
    """Return how many files could not be parsed as a whole, and how many places in them."""
    total = 0
    for one in document["failures"]:
        if one["tool"] == "syntax":
            match = re.match(r"cannot parse (\d+) places", one["what"])
            total += int(match[1]) if match else 1
    return total


def hunks_of(difference: str, name: str) -> Iterator[str]:
    """Yield the hunks of a diff, each with its file."""
    for part in re.split(r"^diff --git ", difference, flags=re.MULTILINE)[1:]:
        head, *hunks = re.split(r"^(?=@@ )", part, flags=re.MULTILINE)
        match = re.search(r"^\+\+\+ \"?b/after/(.*)$", head, re.MULTILINE)
        if match is None or "/.roslens/" in match[1]:
            continue
        yield from (f"=== {name}: {match[1].partition('/')[2]}\n{hunk}" for hunk in hunks)


def compiled(before: Path, after: Path, options: argparse.Namespace) -> tuple[int, int, list[str]]:
    """Return how many of the sources that changes concern compile before, how many of them after, and which do not."""
    if not options.compile:
        return 0, 0, []
    changed = {
        path.relative_to(after).as_posix()
        for path in after.rglob("*")
        if path.is_file()
        and ".roslens" not in path.parts
        and path.read_bytes() != (before / path.relative_to(after)).read_bytes()
    }
    headers = {name.rpartition("/")[2].encode() for name in changed if name.endswith((".h", ".hpp", ".hh"))}
    concerned = []
    for path in sorted(after.rglob("*")):
        if path.suffix not in (".cpp", ".cc", ".cxx") or not path.is_file():
            continue
        name = path.relative_to(after).as_posix()
        included = {one.rpartition(b"/")[2] for one in re.findall(rb'#\s*include\s*[<"]([^>"]+)', path.read_bytes())}
        if name in changed or included & headers:
            concerned.append(name)
    random.Random(1).shuffle(concerned)
    good = kept = 0
    broken: list[str] = []
    for name in concerned[: options.compile]:
        wrong = complaint(after, name, options)
        if wrong and complaint(before, name, options):
            continue
        good += 1
        kept += not wrong
        if wrong:
            broken.append(f"{name}: {wrong}")
    return good, kept, broken


def complaint(root: Path, name: str, options: argparse.Namespace) -> str:
    """Return the first error of g++, empty where a source compiles."""
    folders = sorted({folder for folder in root.rglob("include") if folder.is_dir()})
    own = [(root / name).parent, *folders]
    words = [f"-I{folder}" for folder in own] + [f"-isystem{folder}" for folder in options.include]
    words += [f"-iquote{folder}" for folder in options.quote]
    command = ["g++", "-std=c++17", "-fsyntax-only", "-w", *words, str(root / name)]
    done = subprocess.run(
        command, capture_output=True, text=True, errors="replace", env={**os.environ, "LC_ALL": "C"}, check=False
    )
    first = next((line for line in done.stderr.splitlines() if "error" in line), "an error")
    return first if done.returncode else ""


if __name__ == "__main__":
    sys.exit(main())
