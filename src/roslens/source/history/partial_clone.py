"""Whether a clone leaves contents out that git would fetch when it is asked for them."""

from __future__ import annotations

from roslens.source.history.git_answer import HistoryError, git_answer

PARTIAL_SETTINGS = r"^(remote\..*\.promisor|extensions\.partialclone)$"
"""Names of settings that only a partial clone has, as git's ``config --get-regexp`` takes them."""


def is_partial(top: str) -> bool:
    """Return whether contents of files, or lists of them, may be missing in the repository of the folder ``top``."""
    try:
        return bool(git_answer(top, "config", "--get-regexp", PARTIAL_SETTINGS))
    except HistoryError:
        return False
