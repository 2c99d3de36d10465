"""Once git is ended, nothing waits for a network and nothing is started any more."""

import threading
import time

import pytest

from roslens.source.fetch.git_runner import GitError, GitRunner
from roslens.source.fetch.retry import Retry
from roslens.source.tools.running.run_tool import ToolError, ToolRunner


def test_a_pause_ends_and_no_other_try_begins(tmp_path, monkeypatch):
    over = threading.Event()
    waiting = threading.Event()
    tries = []

    def wait(seconds):
        waiting.set()
        over.wait(seconds)

    git = GitRunner(Retry(wait, (60.0, 60.0), end=over.set))

    def broken(*_, **__):
        tries.append(1)
        raise GitError("connection reset by peer")

    monkeypatch.setattr(git, "_run", broken)
    errors = []

    def fetch():
        try:
            git.over_network(str(tmp_path), "fetch")
        except GitError as error:
            errors.append(str(error))

    thread = threading.Thread(target=fetch)
    thread.start()
    assert waiting.wait(30)
    git.end_all()
    thread.join(10)
    assert not thread.is_alive()
    assert (errors, tries) == (["it was ended"], [1])


def test_a_git_that_is_killed_is_no_broken_network(tmp_path):
    git = GitRunner(Retry(lambda _: pytest.fail("it waited"), (60.0,)))
    git.end_all()
    with pytest.raises(GitError, match="is being ended"):
        git.over_network(str(tmp_path), "fetch")


def test_nothing_is_started_once_all_was_ended(tmp_path):
    runner = ToolRunner()
    runner.end_all()
    begun = time.monotonic()
    with pytest.raises(ToolError, match="is being ended"):
        runner.run(["/bin/sleep", "60"], folder=str(tmp_path), time_limit_s=120)
    assert time.monotonic() - begun < 30
