"""``PYTHONPATH=tests python -m process_metrics FOLDER...``: hold clones against git, and say what differs."""

import sys
from pathlib import Path

from process_metrics.against_git import differences


def main() -> int:
    wrong = 0
    for folder in map(Path, sys.argv[1:]):
        compared, found = differences(folder.resolve())
        print(f"{folder}: {compared} answers compared, {len(found)} differ")
        for one in found:
            print(f"  {one.entity} {one.quantity}: {one.ours}, git says {one.gits}")
        wrong += len(found)
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
