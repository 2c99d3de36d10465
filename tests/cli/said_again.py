"""What a check says with what it kept of earlier ones, and without."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

from roslens.cli.main import main


def said(root: Path, *options: str):
    """Return the report of a check, without what is known of the run."""
    place = root.with_suffix(".json")
    main(["check", str(root), "--jobs", "1", "-q", "--fail-on", "never", "-o", str(place), *options])
    found = json.loads(place.read_text())
    found.pop("run", None)
    return found


def fresh(root: Path):
    """Return what a check says that knows nothing of the workspace."""
    kept, aside = root / ".roslens", root.with_suffix(".aside")
    kept.rename(aside)
    try:
        return said(root, "--no-cache")
    finally:
        shutil.rmtree(kept, ignore_errors=True)
        aside.rename(kept)
