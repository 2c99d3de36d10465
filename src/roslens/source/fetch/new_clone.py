"""An empty clone, written as ``git init`` and ``git config`` would: those are three processes for five small files."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from roslens.children.fetching_git import ATTRIBUTES

_HEAD = "ref: refs/heads/main\n"
_FOLDERS = ("objects/info", "objects/pack", "refs/heads", "refs/tags", "info")
_CONFIG = """\
[core]
\trepositoryformatversion = 0
\tfilemode = {filemode}
\tbare = false
\tlogallrefupdates = true
[remote "origin"]
\turl = "{url}"
\tfetch = +refs/heads/*:refs/remotes/origin/*
"""


def begin_clone(folder: Path, url: str) -> None:
    """Make an empty clone of ``url`` in a folder that is there.

    Raises:
        OSError: it cannot be written.
    """
    inside = folder / ".git"
    for name in _FOLDERS:
        (inside / name).mkdir(parents=True, exist_ok=True)
    (inside / "HEAD").write_text(_HEAD)
    config = inside / "config"
    config.touch()
    quoted = url.replace("\\", "\\\\").replace('"', '\\"')
    config.write_text(_CONFIG.format(filemode="true" if _keeps_modes(config) else "false", url=quoted))
    (inside / "info" / "attributes").write_text(ATTRIBUTES)


def set_head(folder: Path, commit: str) -> None:
    """Have a clone be at a commit, on no branch.

    Raises:
        OSError: it cannot be written.
    """
    part = folder / ".git" / "HEAD.part"
    part.write_text(f"{commit}\n")
    part.replace(folder / ".git" / "HEAD")


def _keeps_modes(path: Path) -> bool:
    """Return whether the file system keeps what may be started as a program, as ``git init`` finds out, too."""
    before = path.stat().st_mode
    try:
        path.chmod(before ^ stat.S_IXUSR)
        kept = path.stat().st_mode != before
        path.chmod(before)
    except OSError:
        return False
    return kept and os.name == "posix"
