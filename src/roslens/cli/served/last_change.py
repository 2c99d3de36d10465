"""Who changed a file of a workspace last, by its git history."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from roslens.dashboard.last_change import LastChange

_FORM = "%an%x00%as%x00%h%x00%s"
_KEPT = 4096


def last_change_in(root: str) -> Callable[[str], LastChange | None]:
    """Return a look-up by path below ``root``; it asks git once for each file, and nothing where there is no git."""

    @lru_cache(maxsize=_KEPT)
    def found(path: str) -> LastChange | None:
        from roslens.cli.git.git_repository import Repository
        from roslens.dashboard.last_change import LastChange
        from roslens.model.errors import UsageError

        whole = Path(root, path)
        try:
            # From the folder of the file: a workspace may hold many repositories.
            done = Repository(str(whole.parent)).git("log", "-1", f"--format={_FORM}", "--", whole.name)
        except UsageError:
            return None
        parts = done.stdout.decode("utf-8", "replace").rstrip("\n").split("\0")
        return LastChange(*parts) if done.returncode == 0 and len(parts) == 4 else None

    return found
