"""The newest changes of the main line of a repository, from git."""

from __future__ import annotations

import os
from pathlib import Path

from roslens.source.evidence.changes import LOOKED_AT, Change
from roslens.source.history.git_answer import HistoryError, git_answer

_SIGNED = "%x00%s%x00%P%x00%(trailers:key=Signed-off-by,valueonly,separator=%x2C)%x01"


def read_changes(repository: Path) -> tuple[Change, ...] | None:
    """Return the last changes, newest first; None where there is no repository of its own, or git does not answer."""
    if not os.path.lexists(repository / ".git"):
        return None
    try:
        text = git_answer(
            str(repository), "log", "--first-parent", f"--max-count={LOOKED_AT}", f"--format={_SIGNED}", limit_s=30
        )
    except HistoryError:
        return None
    found = []
    for entry in text.decode("utf-8", "replace").split("\x01"):
        fields = entry.strip("\n").split("\x00")
        if len(fields) == 4:
            _, subject, parents, signed = fields
            found.append(Change(subject, len(parents.split()), bool(signed.strip())))
    return tuple(found)
