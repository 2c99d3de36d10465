"""Git that fetches remote repositories into clones that roslens made: it runs no hooks, and never prompts.

What comes from a server can name programs only through attributes, which :data:`ATTRIBUTES` overrules, through
submodules, which are never followed, and through hooks, of which there are none. What the user's own configuration
says of credentials, proxies and certificates is used; only :data:`SCHEMES` are spoken.
"""

from __future__ import annotations

from collections.abc import Mapping

from roslens.children.safe_path import without_current_folder

COMMANDS = frozenset(
    {
        "cat-file", "config", "diff-index", "fetch", "for-each-ref", "init", "ls-files", "ls-remote", "ls-tree",
        "merge-base", "read-tree", "rev-list", "rev-parse", "update-index", "update-ref",
    }
)  # fmt: skip
"""What git may be asked; none of these runs a hook."""

SCHEMES = ("http", "https", "ssh", "file")

ATTRIBUTES = "* -text -filter -ident -working-tree-encoding !diff -merge\n"
"""For ``info/attributes``, which is above all that a repository brings: every file is written as git keeps it, and none
is compared by a program. ``-diff`` would do that, too, but git counts no lines of such a file: it takes it for binary.
"""

CONFIGURATION = frozenset(
    {
        "core.repositoryformatversion", "core.filemode", "core.bare", "core.logallrefupdates", "core.symlinks",
        "core.ignorecase", "core.precomposeunicode", "core.sparsecheckout", "extensions.partialclone",
        "remote.origin.url",
        "remote.origin.fetch", "remote.origin.promisor", "remote.origin.partialclonefilter",
    }
)  # fmt: skip
"""Keys that a clone made by roslens has; one with others is not fetched into, for some of them start programs."""

_OPTIONS = (
    "safe.bareRepository=explicit",
    "core.fsmonitor=false",
    "core.hooksPath=/dev/null",
    "core.attributesFile=/dev/null",
    "core.autocrlf=false",
    "core.protectHFS=true",
    "core.protectNTFS=true",
    "core.askPass=",
    "core.pager=cat",
    "core.alternateRefsCommand=true",
    "core.splitIndex=false",
    "index.version=2",
    "diff.external=",
    "diff.ignoreSubmodules=all",
    "gc.auto=0",
    "maintenance.auto=false",
    "submodule.recurse=false",
    "fetch.recurseSubmodules=false",
    "advice.detachedHead=false",
    "http.lowSpeedLimit=1000",
    "http.lowSpeedTime=60",
    "protocol.allow=never",
    *(f"protocol.{scheme}.allow=always" for scheme in SCHEMES),
)
_LEFT_OUT = frozenset(
    {
        "GIT_ALTERNATE_OBJECT_DIRECTORIES", "GIT_ASKPASS", "GIT_COMMON_DIR", "GIT_CONFIG_PARAMETERS", "GIT_DIR",
        "GIT_EXTERNAL_DIFF", "GIT_INDEX_FILE", "GIT_NAMESPACE", "GIT_NO_LAZY_FETCH", "GIT_OBJECT_DIRECTORY",
        "GIT_PAGER", "GIT_TEMPLATE_DIR", "GIT_WORK_TREE", "SSH_ASKPASS",
    }
)  # fmt: skip


_OF_A_FOLDER = "remote.origin.uploadpack=git -c uploadpack.allowFilter=true upload-pack"
"""Whoever can read a folder of this machine can as well have a part of it; servers say themselves what they allow."""


def fetching_words(folder: str, command: str, *arguments: str, local: bool = False) -> list[str]:
    """Return the words that run a git command in ``folder``.

    Args:
        folder: of the clone.
        command: one of :data:`COMMANDS`.
        arguments: its own.
        local: whether what is fetched from is a folder of this machine.

    Raises:
        ValueError: the command is none of :data:`COMMANDS`.
    """
    if command not in COMMANDS:
        raise ValueError(f"git {command} may start what a repository brings; allowed: {sorted(COMMANDS)}")
    chosen = (*_OPTIONS, _OF_A_FOLDER) if local else _OPTIONS
    options = [word for option in chosen for word in ("-c", option)]
    # Named, so that no repository around the folder is taken in its place.
    where = () if command == "init" else ("--git-dir=.git",)
    return ["git", "--no-pager", *options, "-C", folder, *where, command, *arguments]


def fetching_environment(base: Mapping[str, str]) -> dict[str, str]:
    """Return the environment for git: the user's ways to servers stay, whatever would ask on the terminal goes.

    Args:
        base: of this process.
    """
    kept = {name: value for name, value in without_current_folder(base).items() if name not in _LEFT_OUT}
    return {
        **kept,
        "GIT_ALLOW_PROTOCOL": ":".join(SCHEMES),
        "GIT_TERMINAL_PROMPT": "0",
        "GIT_LFS_SKIP_SMUDGE": "1",
        "GIT_ATTR_NOSYSTEM": "1",
        "GCM_INTERACTIVE": "never",
        "SSH_ASKPASS_REQUIRE": "never",
        "LC_ALL": "C",
    }
