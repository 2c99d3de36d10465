"""Writing a file whole or not at all: a full disk or an interrupt never leaves half a report behind."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from roslens.report.writing.control_characters import ShownControls
from roslens.report.writing.left_behind import PART, beside, sweep


@contextmanager
def whole_file(path: Path) -> Iterator[TextIO]:
    """Open a text file that takes the place of ``path`` once the block is over.

    What a link points to is replaced, not the link. What is no regular file, such as ``/dev/null`` or a pipe, is
    written to as it is. Control characters are written out: no report has one.

    Raises:
        OSError: the folder cannot be made, or the file not be written.
    """
    target = path.resolve()
    if target.exists() and not target.is_file():
        with ShownControls(target.open("wb"), encoding="utf-8", newline="") as stream:
            yield stream
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    sweep(target)
    part = beside(target, PART)
    try:
        with ShownControls(part.open("wb"), encoding="utf-8", newline="") as stream:
            yield stream
        part.replace(target)
    finally:
        part.unlink(missing_ok=True)
