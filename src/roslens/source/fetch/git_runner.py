"""Git for fetching: bounded in time, gone when roslens is, tried again where the network broke it."""

from __future__ import annotations

import os
from threading import Event

from roslens.children.fetching_git import fetching_environment, fetching_words
from roslens.source.fetch.retry import Retry, may_pass
from roslens.source.tools.running.run_tool import Ended, ToolError, ToolRunner, ToolTalkError

TIME_LIMIT_S = 3600.0
"""For one command: the largest repositories of a distribution take a quarter of an hour on a slow line."""

_MOST_PROCESSES = 60
"""Of one command. A server that leaves out commits which it should have makes git start another git, endlessly."""


_UNREAD = "Could not read from remote repository"
_ADVICE = ("Please make sure you have the correct access rights", "and the repository exists.")


class GitError(Exception):
    """Git did not do what it was asked for; the text is what it said."""


class PrintedTooMuchError(GitError):
    """Git printed more than is read."""


class GitRunner:
    """Runs git from any thread; :meth:`end_all` ends what runs."""

    def __init__(self, retry: Retry, *, time_limit_s: float = TIME_LIMIT_S) -> None:
        """Try again by ``retry``, and end what takes longer than ``time_limit_s``."""
        self._retry = retry
        self._over = Event()
        self._time_limit_s = time_limit_s
        self._runner = ToolRunner()
        self._program = _program()
        self._environment = fetching_environment(os.environ)

    def ask(self, folder: str, command: str, *arguments: str) -> str | None:
        """Return what git prints; None if its answer is negative (exit code 1, or 5 of ``git config``).

        Raises:
            GitError: it failed otherwise.
        """
        done = self._run(folder, command, arguments)
        return None if done.code in (1, 5) else _output(done)

    def do(self, folder: str, command: str, *arguments: str) -> str:
        """Return what git prints.

        Raises:
            GitError: it failed, or could not be run.
        """
        return _output(self._run(folder, command, arguments))

    def over_network(self, folder: str, command: str, *arguments: str, local: bool = False) -> str:
        """Do what may need the network, again after a pause where that may help.

        Args:
            folder: of the clone.
            command: of git.
            arguments: its own.
            local: whether the other side is a folder of this machine.

        Raises:
            GitError: the last try failed too, or trying again would not help.
        """
        for pause in (*self._retry.pauses_s, None):
            try:
                return _output(self._run(folder, command, arguments, local=local))
            except GitError as error:
                if pause is None or self._over.is_set() or not may_pass(str(error)):
                    raise
            self._pause(pause)
        raise AssertionError("unreachable")

    def end_all(self) -> None:
        """End every git that runs now, and every pause, and let no other begin."""
        self._over.set()
        self._retry.end()
        self._runner.end_all()

    def _pause(self, seconds: float) -> None:
        self._retry.sleep(seconds)
        if self._over.is_set():
            raise GitError("it was ended")

    def _run(self, folder: str, command: str, arguments: tuple[str, ...], *, local: bool = False) -> Ended:
        words = fetching_words(folder, command, *arguments, local=local)
        try:
            return self._runner.run(
                [self._program, *words[1:]],
                folder=folder,
                time_limit_s=self._time_limit_s,
                environment=self._environment,
                most_processes=_MOST_PROCESSES,
            )
        except ToolTalkError as error:
            raise PrintedTooMuchError(str(error)) from error
        except ToolError as error:
            raise GitError(str(error)) from error


def _program() -> str:
    from shutil import which

    return which("git") or "git"


def _output(done: Ended) -> str:
    if done.code:
        raise GitError(_said(done))
    return done.stdout.decode("utf-8", "surrogateescape")


def _said(done: Ended) -> str:
    lines = [line.strip() for line in done.stderr[-8192:].decode("utf-8", "replace").splitlines()]
    reported = [line for line in lines if line.startswith(("fatal:", "error:", "remote:", "ssh:"))]
    if any(_UNREAD in line for line in reported):
        # What kept ssh out stands before, in a line of its own, and git's advice behind.
        reported = [line for line in lines if line not in _ADVICE]
    words = " ".join(dict.fromkeys(reported)) or " ".join(line for line in lines if line) or done.complaint()
    return words[:500]
