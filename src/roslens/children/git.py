"""Git, asked about a repository that may be hostile: nothing that the repository configures is started.

A clone can hold a bare repository in a folder of its own, whose configuration git would read there: filters, hooks,
file system monitors, text conversions and differences by programs. So only commands that look at objects and the index
are allowed, none that reads files of the work tree through filters; everything that can name a program is empty.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from roslens.children.safe_path import without_current_folder

COMMANDS = frozenset(
    {
        "cat-file",
        "check-mailmap",
        "config",
        "diff-tree",
        "for-each-ref",
        "log",
        "ls-files",
        "ls-tree",
        "rev-list",
        "rev-parse",
    }
)
"""What git may be asked: none of these runs a filter or writes."""

_OPTIONS = (
    "safe.bareRepository=explicit",
    "core.fsmonitor=false",
    "core.hooksPath=/dev/null",
    "core.attributesFile=/dev/null",
    "core.sshCommand=false",
    "core.askPass=",
    "core.pager=cat",
    "core.alternateRefsCommand=true",
    "credential.helper=",
    "diff.external=",
    "log.showSignature=false",
    "protocol.allow=never",
    "submodule.recurse=false",
)
_DIFFERENCES = frozenset({"diff-tree", "log"})
_LEFT_OUT = ("GIT_EXTERNAL_DIFF", "GIT_SSH", "GIT_SSH_COMMAND", "GIT_ASKPASS", "SSH_ASKPASS", "GIT_PAGER")


def git_words(folder: str, command: str, *arguments: str) -> list[str]:
    """Return the words that run a git command on the repository that ``folder`` is in.

    Raises:
        ValueError: the command is none of :data:`COMMANDS`.
    """
    if command not in COMMANDS:
        raise ValueError(f"git {command} may start what a repository configures; allowed: {sorted(COMMANDS)}")
    options = [word for option in _OPTIONS for word in ("-c", option)]
    quiet = ("--no-ext-diff", "--no-textconv") if command in _DIFFERENCES else ()
    return ["git", "--no-pager", *options, "-C", folder, command, *quiet, *arguments]


def git_environment(base: Mapping[str, str], objects: Sequence[str] = ()) -> dict[str, str]:
    """Return the environment for git.

    Args:
        base: of this process.
        objects: folders of further objects that git reads as the repository's own.
    """
    kept = {name: value for name, value in without_current_folder(base).items() if name not in _LEFT_OUT}
    quoted = ('"' + path.replace("\\", "\\\\").replace('"', '\\"') + '"' for path in objects)
    more = {"GIT_ALTERNATE_OBJECT_DIRECTORIES": os.pathsep.join(quoted)} if objects else {}
    return {
        **kept,
        "GIT_TERMINAL_PROMPT": "0",
        "GIT_NO_LAZY_FETCH": "1",
        "GIT_OPTIONAL_LOCKS": "0",
        "GIT_ATTR_NOSYSTEM": "1",
        "LC_ALL": "C",
        **more,
    }


def looks_bare(folder: str) -> str:
    """Return the first folder at or above ``folder`` that git would take for a bare repository; empty for none.

    Versions of git before 2.38 do not know ``safe.bareRepository``, and would read its configuration.
    """
    path = Path(folder).resolve()
    for place in (path, *path.parents):
        if (place / ".git").exists():
            return ""
        if (place / "HEAD").exists() and (place / "objects").is_dir() and (place / "refs").is_dir():
            return str(place)
    return ""
