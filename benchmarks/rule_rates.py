"""How often each rule and limit is broken in the field: findings per thousand lines of own code.

``python benchmarks/rule_rates.py CLONES [-o FILE]``: CLONES is a folder with clones of repositories, each of which is
checked by the command a user runs. The table has, for each rule, findings that count per kLOC over all of it, the
median over repositories, and in how many it occurs.
"""

import argparse
import csv
import json
import statistics
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path


def of_repository(clone: Path) -> tuple[float, Counter[tuple[str, str]]]:
    """Return thousands of lines of code that count, and findings that count by rule and severity."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder, "run.json")
        command: list[str | Path] = [
            Path(sys.executable).with_name("roslens"),
            "check",
            clone,
            "--no-store",
            "--no-cache",
            "-q",
        ]
        command += ["--fail-on", "never", "--format", "json", "-o", out]
        subprocess.run(command, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        if not out.is_file():
            return 0.0, Counter()
        run = json.loads(out.read_text("utf-8"))
    own = {f"file:{file['path']}" for file in run["files"] if file["role"] == "own"}
    lines = sum(one["value"] for one in run["measurements"] if one["quantity"] == "loc" and one["entity"] in own)
    found = Counter((one["rule"], one["severity"]) for one in run["findings"] if one.get("gated", True))
    return lines / 1000, found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("clones", type=Path)
    parser.add_argument("-o", "--output", type=Path)
    options = parser.parse_args()
    repositories = {}
    for clone in sorted(one for one in options.clones.iterdir() if one.is_dir()):
        size, found = of_repository(clone)
        print(f"{clone.name}: {size:.1f} kLOC, {sum(found.values())} findings", file=sys.stderr)
        if size:
            repositories[clone.name] = (size, found)
    whole = sum(size for size, _found in repositories.values())
    rows = []
    for key in sorted({key for _size, found in repositories.values() for key in found}):
        rates = [found[key] / size for size, found in repositories.values()]
        total = sum(found[key] for _size, found in repositories.values())
        rows.append((*key, total, round(total / whole, 3), round(statistics.median(rates), 3), sum(map(bool, rates))))
    rows.sort(key=lambda row: -row[3])
    stream = options.output.open("w", encoding="utf-8", newline="") if options.output else sys.stdout
    writer = csv.writer(stream)
    writer.writerow(
        ("rule", "severity", "findings", "per_kloc", "median_per_kloc", f"of_{len(repositories)}_repositories")
    )
    writer.writerows(rows)
    print(f"{len(repositories)} repositories, {whole:.1f} kLOC", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
