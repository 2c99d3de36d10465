"""Guarded programs import as others do, but for what lies in the workspace."""

import subprocess
import sys
from pathlib import Path

import roslens.children.guard

GUARD = Path(roslens.children.guard.__file__).parent


def test_distributions_are_found_where_others_took_over_finding_them(tmp_path):
    # The package importlib_metadata does so where it is imported.
    code = (
        "from importlib.machinery import PathFinder\n"
        "from importlib.metadata import PackageNotFoundError, version\n"
        "import sys\n"
        "print(version('pytest'))\n"
        "del PathFinder.find_distributions\n"
        "try:\n    version('pytest')\nexcept PackageNotFoundError:\n    print('nobody')\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=False,
        cwd=tmp_path,
        env={"PYTHONPATH": str(GUARD), "ROSLENS_GUARDED": str(tmp_path)},
    )
    assert done.stdout.splitlines()[1:] == ["nobody"], done.stderr
