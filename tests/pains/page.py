"""The blocks of docs/why.md: each holds what is said of a reason, behind a comment with its key."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path

from pains.pains import PAINS, Pain

PAGE = Path(__file__).parents[2] / "docs" / "why.md"
_BLOCK = re.compile(r"<!-- (\w+) -->\n```text\n(.*?)```\n", re.DOTALL)


def block(pain: Pain) -> str:
    """Return what stands in the page: the command and the first cause."""
    with tempfile.TemporaryDirectory() as folder:
        return f"$ {pain.asks}\n{pain.says(Path(folder).resolve())}\n"


def blocks(text: str) -> dict[str, str]:
    """Return the blocks of a page by key."""
    return {found[1]: found[2] for found in _BLOCK.finditer(text)}


def written(text: str) -> str:
    """Return a page with all blocks as they are now."""
    by_key = {one.key: one for one in PAINS}
    return _BLOCK.sub(lambda found: f"<!-- {found[1]} -->\n```text\n{block(by_key[found[1]])}```\n", text)
