"""Real files that code is planted into."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from random import Random

_ENDINGS = {"cpp": (".cpp", ".cc"), "header": (".hpp", ".h"), "python": (".py",)}
_LINES = (30, 500)
_SPARED = re.compile(
    rb"gtest|gmock|unittest|pytest|rostest|launch_testing|catch2|<ros\.h>|ros_lib|setup\(|enerated|NOLINT|noqa|roslens:"
)
"""Files for tests and firmware, which rules leave alone, those made by programs, and those that silence tools."""
_ASIDE = re.compile(r"(?:^|/)(?:tests?|third_party|external|vendor|docs?|examples?|\.git)(?:/|$)")


def hosts(folders: Sequence[Path], kind: str, seed: int) -> list[Path]:
    """Return the real files of a kind (``cpp``, ``header``, ``python``) below some folders, in an order by the seed."""
    found = []
    for folder in folders:
        for ending in _ENDINGS[kind]:
            found += [one for one in folder.rglob(f"*{ending}") if _serves(one, folder, kind)]
    found.sort(key=str)
    Random(f"{seed} {kind}").shuffle(found)
    return found


def _serves(path: Path, folder: Path, kind: str) -> bool:
    if _ASIDE.search(str(path.relative_to(folder))) or not path.is_file():
        return False
    content = path.read_bytes()
    if not _LINES[0] <= content.count(b"\n") <= _LINES[1] or b"\r" in content or _SPARED.search(content):
        return False
    if kind == "header" and b"#pragma once" not in content and b"#ifndef" not in content:
        return False
    # What is planted in front of a line needs a whole one before it.
    return content.endswith(b"\n") and content.isascii()
