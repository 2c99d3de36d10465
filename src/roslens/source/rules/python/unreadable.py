"""Files of Python that no Python can read: what they would do, they never do.

The grammar accepts a function without a body, which Python does not.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit

_HEAD = re.compile(rb":(?=[ \t]*(?:\n|\Z))")
"""The end of what begins a block on lines of its own."""
_OF_PYTHON_2 = "python.python2_"
_OF_TEXT = ("node.credential", "python.syntax", "python.encoding")
"""What somebody reads whether the file runs or not, and why it does not."""


def without_what_never_runs(hits: Sequence[Hit], view: FileView) -> list[Hit]:
    """Return hits in a file of Python without those on what it does when it runs, where it cannot be read.

    What Python 2 reads is left: it is said of such a file that it is one.

    Args:
        hits: of rules on the file.
        view: the file.
    """
    left = [hit for hit in hits if not _is_of_what_runs(hit)]
    if (
        len(left) == len(hits)
        or any(hit.rule.startswith(_OF_PYTHON_2) for hit in hits)
        or not _is_unreadable(hits, view)
    ):
        return list(hits)
    return left


def _is_of_what_runs(hit: Hit) -> bool:
    return hit.rule.startswith(("node.", "python.")) and not hit.rule.startswith(_OF_TEXT)


def _is_unreadable(hits: Sequence[Hit], view: FileView) -> bool:
    if view.root.has_error or any(hit.rule == "python.syntax" for hit in hits):
        return True
    return any(_is_empty(match.start(), view) for match in _HEAD.finditer(view.code))


def _is_empty(colon: int, view: FileView) -> bool:
    """Return whether the block behind a colon has no statement."""
    at = view.node_at(colon, colon + 1)
    head = at.parent if at is not None and at.type == ":" else None
    blocks = [one for one in head.children if one.type == "block"] if head is not None else []
    return any(all(each.type == "comment" for each in one.children) for one in blocks)
