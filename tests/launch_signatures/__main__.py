"""Writes a table of signatures: ``python -m launch_signatures FOLDER LIBRARY``.

FOLDER has clones of ``ros2/launch`` and ``ros2/launch_ros``, called ``launch`` and ``launch_ros``, with a branch for
each distribution; LIBRARY is ``launch``, ``launch_ros``, ``launch_xml`` or ``launch_yaml``. Rows of later distributions
are added by hand, each with its source.
"""

from __future__ import annotations

import sys
from pathlib import Path

from launch_signatures.library import Module, read_library
from launch_signatures.table import table

BRANCHES = {
    "foxy": "foxy", "galactic": "galactic", "humble": "humble", "iron": "iron", "jazzy": "jazzy", "kilted": "rolling",
}  # fmt: skip
"""The branch that stands for each distribution."""
CLONES = {"launch": "launch", "launch_xml": "launch", "launch_yaml": "launch", "launch_ros": "launch_ros"}
"""The clone that has each library."""


def main(folder: str, library: str) -> None:
    """Write the table of a library to standard output."""
    read = {distribution: _libraries(Path(folder), branch) for distribution, branch in BRANCHES.items()}
    sys.stdout.write("\n".join(table(read, library)) + "\n")


def _libraries(folder: Path, branch: str) -> dict[str, Module]:
    found: dict[str, Module] = {}
    for library, clone in CLONES.items():
        is_bare = (folder / clone / "HEAD").exists()
        found |= read_library(folder / clone, branch if is_bare else f"origin/{branch}", library)
    return found


if __name__ == "__main__":
    main(*sys.argv[1:])
