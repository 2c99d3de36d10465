"""One question to git, asked so that nothing a repository configures is started."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Sequence

from roslens.children.git import git_environment, git_words

LIMIT_S = 600.0
"""How long git may take for a log; 68,000 commits take a minute."""

_ALWAYS = ("core.quotePath=false", "i18n.logOutputEncoding=UTF-8", "mailmap.file=/dev/null", "log.showRoot=true")
"""What the answer must not depend on: settings of the user and of the repository."""


LACKS_OBJECTS = "Bring them: `roslens fetch --whole` for what it fetched, else `git fetch --refetch --no-filter`"
"""What to do about a clone in which contents of the past are missing."""


class HistoryError(Exception):
    """Git did not answer; the text is what it said, in one line."""


def git_answer(folder: str, command: str, *arguments: str, given: bytes = b"", limit_s: float = LIMIT_S) -> bytes:
    """Return what git writes.

    Args:
        folder: in the work tree of the repository.
        command: one of :data:`roslens.children.git.COMMANDS`.
        arguments: of the command.
        given: to standard input.
        limit_s: seconds after which git is ended.

    Raises:
        HistoryError: git is not there, takes too long, or ends with an error.
    """
    try:
        done = subprocess.run(
            _words(folder, command, arguments), input=given, capture_output=True, timeout=limit_s, check=False,
            env=git_environment(os.environ),
        )  # fmt: skip
    except FileNotFoundError as error:
        raise HistoryError("git is not installed") from error
    except OSError as error:
        raise HistoryError(f"git cannot be started: {error}") from error
    except subprocess.TimeoutExpired as error:
        raise HistoryError(f"git {command} did not answer in {limit_s:g} s") from error
    if done.returncode:
        said = " ".join(done.stderr.decode("utf-8", "replace").split())
        raise HistoryError(said or f"git {command} ended with {done.returncode} and no message")
    return done.stdout


def _words(folder: str, command: str, arguments: Sequence[str]) -> list[str]:
    words = git_words(folder, command, *arguments)
    options = [word for option in _ALWAYS for word in ("-c", option)]
    return [words[0], *options, *words[1:]]
