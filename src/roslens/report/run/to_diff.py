"""Changes of files as a unified diff that ``git apply`` and ``patch -p1`` take."""

from __future__ import annotations

import difflib
from collections.abc import Iterator


def to_diff(path: str, before: bytes, after: bytes) -> Iterator[bytes]:
    """Yield the lines of the diff of a file; the bytes of the file stay what they are.

    Args:
        path: of the file, below the folder in which the diff is applied.
        before: its content.
        after: its content afterwards.
    """
    old, new = _by_line_feed(before), _by_line_feed(after)
    name = path.encode("utf-8", "surrogateescape")
    for line in difflib.diff_bytes(
        difflib.unified_diff, old, new, b"a/" + _quoted(name), b"b/" + _quoted(name), lineterm=b"\n"
    ):
        yield line if line.endswith(b"\n") else line + b"\n\\ No newline at end of file\n"


def _by_line_feed(content: bytes) -> list[bytes]:
    """Return lines as diff counts them: a carriage return or form feed ends none."""
    parts = content.split(b"\n")
    lines = [part + b"\n" for part in parts[:-1]]
    return [*lines, parts[-1]] if parts[-1] else lines


def _quoted(name: bytes) -> bytes:
    # A name with a blank is ended by a tabulator, as git and GNU diff do it.
    return name + b"\t" if b" " in name else name
