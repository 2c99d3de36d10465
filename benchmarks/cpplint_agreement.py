"""Compares native rules with cpplint, category by category: ``python -m cpplint_agreement FOLDER…`` in ``benchmarks``.

Each folder is a clone. What cpplint reports in the categories that native rules name among their clauses is set against
what ``roslens check`` reports with just these rules on, by file and line. The page is written to
``docs/accuracy_of_rules_against_cpplint.md``; the reasons below are judged by reading what only one of the two reports.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from collections.abc import Mapping
from pathlib import Path

from roslens.source.rules.published.standards import CPPLINT, answers
from roslens.source.rules.table import native_rules

ROOT = Path(__file__).parent.parent
PAGE = ROOT / "docs" / "accuracy_of_rules_against_cpplint.md"
ENDINGS = ("c", "cc", "cpp", "cxx", "h", "hh", "hpp", "hxx")
NEAR = 2
"""Lines by which the two may differ about one thing: a declaration over several lines."""

REASONS = json.loads((Path(__file__).parent / "cpplint_agreement.json").read_text())
"""Why they differ, by category."""

Place = tuple[str, int]


def of_cpplint(folder: Path, cpplint: str, categories: list[str]) -> dict[str, set[Place]]:
    """Return the places of each category, paths below the folder."""
    files = [str(one) for end in ENDINGS for one in sorted(folder.rglob(f"*.{end}")) if one.is_file()]
    filters = ",".join(["-", *(f"+{one}" for one in categories)])
    found: dict[str, set[Place]] = defaultdict(set)
    for at in range(0, len(files), 200):
        command = [cpplint, "--quiet", f"--filter={filters}", f"--extensions={','.join(ENDINGS)}"]
        run = subprocess.run([*command, *files[at : at + 200]], capture_output=True, text=True, check=False)
        for line in run.stderr.splitlines():
            if match := re.match(r"(.*?):(\d+|None):  .*  \[([\w/+]+)\] \[\d\]$", line):
                path = str(Path(match[1]).relative_to(folder))
                found[match[3]].add(place(path, int(match[2]) if match[2].isdigit() else 0, line))
    return found


def of_roslens(folder: Path, rules: list[str]) -> tuple[dict[str, set[Place]], set[str]]:
    """Return the places of each rule and the files that were looked at."""
    with tempfile.TemporaryDirectory() as scratch:
        settings, result = Path(scratch, "roslens.toml"), Path(scratch, "run.json")
        named = ", ".join(f'"{one}"' for one in rules)
        settings.write_text(f"[rules]\nprofiles = []\nenable = [{named}]\n")
        command = [
            str(Path(sys.executable).with_name("roslens")),
            "check",
            str(folder),
            "--config",
            str(settings),
            "--no-store",
        ]
        options = ["--no-cache", "--fail-on", "never", "--format", "json", "-o", str(result)]
        subprocess.run([*command, *options], check=True, capture_output=True)
        run = json.loads(result.read_text())
    found: dict[str, set[Place]] = defaultdict(set)
    for one in run["findings"]:
        if one["rule"] in rules:
            found[one["rule"]].add(place(one["path"], one["line"], one["message"]))
    return found, files_of(run)


def place(path: str, line: int, message: str) -> Place:
    """Return what is compared: file and line, or file and header of a missing include."""
    header = re.search(r"#include <([\w.]+)>", message)
    return (f"{path}: {header[1]}", 0) if header else (path, line)


def files_of(run: Mapping[str, list[dict[str, str]]]) -> set[str]:
    """Return the files that are of packages and neither vendored nor generated: rules look at no others."""
    return {one["path"] for one in run["files"] if one["role"] in ("own", "test")}


def compare(theirs: set[Place], ours: set[Place]) -> tuple[int, int, int]:
    """Return how many places both name, only cpplint, only roslens."""
    left = set(ours)
    both = 0
    for path, line in sorted(theirs):
        near = next((p for d in range(NEAR + 1) for p in ((path, line + d), (path, line - d)) if p in left), None)
        if near is None and line == 0:
            near = next((p for p in left if p[0] == path), None)
        if near is not None:
            left.discard(near)
            both += 1
    return both, len(theirs) - both, len(left)


def main() -> int:
    """Compare over all folders and write the page."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("folders", nargs="+", type=Path)
    options.add_argument("--cpplint", default="cpplint", help="command")
    options.add_argument("--examples", action="store_true", help="print what only one of the two reports")
    given = options.parse_args()
    by_category = answers(native_rules())[CPPLINT]
    rules = sorted({one for ids in by_category.values() for one in ids})
    total: dict[str, Counter[str]] = defaultdict(Counter)
    for folder in given.folders:
        ours, looked = of_roslens(folder, rules)
        theirs = of_cpplint(folder, given.cpplint, sorted(by_category))
        for category, ids in by_category.items():
            here = {one for rule in ids for one in ours[rule]}
            there = {one for one in theirs[category] if one[0].partition(": ")[0] in looked}
            both, lost, new = compare(there, here)
            total[category].update(both=both, cpplint=lost, roslens=new)
            if given.examples:
                for name, places in (("cpplint", there - here), ("roslens", here - there)):
                    for path, line in sorted(places)[:6]:
                        print(f"{category} only {name}: {folder.name}/{path}:{line}")
    said = subprocess.run([given.cpplint, "--version"], capture_output=True, text=True, check=False).stdout
    version = (re.findall(r"\d+(?:\.\d+)+", said) or ["of an unknown version"])[0]
    PAGE.write_text(page([one.name for one in given.folders], version, by_category, total))
    print(PAGE)
    return 0


def page(
    names: list[str], version: str, by_category: Mapping[str, tuple[str, ...]], total: Mapping[str, Counter[str]]
) -> str:
    """Return the page."""
    folders = ", ".join(f"`{one.replace('+', '/')}`" for one in names)
    text = f"""\
# Native rules against cpplint

Cloned repositories: {folders}.
By category of cpplint {version}, places that both name, that only cpplint names and that
only the native rules name, by file and line (within {NEAR} lines); *recall* is the share of what cpplint names that the
rules name, *agreed* the share of what the rules name that cpplint names. Files that are vendored,
generated or of no package are left out. Which rule answers which category is in
[the table of standards](reference/standards.md). `python benchmarks/cpplint_agreement.py FOLDER… --cpplint COMMAND`
writes this page; the reasons (`benchmarks/cpplint_agreement.json`) are judged by reading what only one of the two
reports (`--examples`).

| category | both | only cpplint | only roslens | recall | agreed | why |
| --- | --: | --: | --: | --: | --: | --- |
"""
    for category in sorted(by_category):
        count = total[category]
        if not sum(count.values()):
            continue
        reason = REASONS.get(category, "")
        shares = " | ".join(share(count["both"], count["both"] + count[other]) for other in ("cpplint", "roslens"))
        text += f"| `{category}` | {count['both']} | {count['cpplint']} | {count['roslens']} | {shares} | {reason} |\n"
    silent = sorted(f"`{one}`" for one in by_category if not sum(total[one].values()))
    return text + f"\nNeither reports anything in {', '.join(silent)}.\n"


def share(part: int, whole: int) -> str:
    """Return a share as the page writes it."""
    return f"{100 * part / whole:.0f} %" if whole else "-"


if __name__ == "__main__":
    sys.exit(main())
