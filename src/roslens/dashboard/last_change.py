"""Who changed a file last."""

from __future__ import annotations

import msgspec


class LastChange(msgspec.Struct, frozen=True):
    """The last commit that changed a file.

    Attributes:
        author: name of who wrote it.
        date: of writing, as YYYY-MM-DD.
        commit: hash, shortened.
        subject: first line of its message.
    """

    author: str
    date: str
    commit: str
    subject: str


def unknown_change(path: str) -> LastChange | None:  # noqa: ARG001 - the shape of every lookup
    """Return nothing: of no file it is known who changed it."""
    return None
