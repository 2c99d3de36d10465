"""The revision that a sentence means."""

import pytest

from roslens.model.errors import UsageError
from roslens.source.fetch.at import At, parse_at, revision_at
from roslens.source.fetch.git_runner import GitError, GitRunner
from roslens.source.fetch.retry import Retry


@pytest.mark.parametrize(
    ("text", "at"),
    [
        ("2015-10-16", At(date="2015-10-16")),
        ("2015-10-16T12:00:00", At(date="2015-10-16T12:00:00")),
        ("292", At(commits=292)),
        ("20151016", At(commit="20151016")),
        ("05a98d9e", At(commit="05a98d9e")),
        ("count", At(counted=True)),
    ],
)
def test_what_it_says(text, at):
    assert parse_at(text) == at
    assert at.text() == text


@pytest.mark.parametrize("text", ["", "0", "yesterday", "2015-13-01", "HEAD", "-1", "05A98D9E"])
def test_what_it_does_not_say(text):
    with pytest.raises(UsageError, match="a number of commits"):
        parse_at(text)


@pytest.fixture
def branched(server):
    """Five commits on the main line, and two beside it that are merged last; returns their ids by letter."""
    server.make("r")
    ids = {
        letter: server.commit("r", {"a": letter}, day=f"2020-01-0{number}") for number, letter in enumerate("abc", 1)
    }
    server.git("r", "checkout", "-q", "-b", "side")
    ids["s"] = server.commit("r", {"s": "1"}, day="2020-01-05")
    ids["t"] = server.commit("r", {"s": "2"}, day="2020-01-06")
    server.git("r", "checkout", "-q", "main")
    ids["d"] = server.commit("r", {"a": "d"}, day="2020-01-07")
    server.git("r", "merge", "-q", "--no-ff", "-m", "m", "side", when="2020-01-08T12:00:00 +0000")
    ids["m"] = server.git("r", "rev-parse", "HEAD")
    return str(server.folder / "r"), ids


@pytest.fixture
def git():
    return GitRunner(Retry(lambda _: None))


@pytest.mark.parametrize(("count", "letter"), [(1, "a"), (3, "c"), (4, "d"), (5, "t"), (7, "m")])
def test_so_many_commits(git, branched, count, letter):
    folder, ids = branched
    assert revision_at(git, folder, ids["m"], At(commits=count), count) == ids[letter]


def test_no_commit_has_so_many(git, branched):
    folder, ids = branched
    with pytest.raises(
        GitError, match=rf"no commit has 6 commits behind it; {ids['d'][:12]} has 4, {ids['m'][:12]} has 7"
    ):
        revision_at(git, folder, ids["m"], At(commits=6), 6)


def test_a_day(git, branched):
    folder, ids = branched
    assert revision_at(git, folder, ids["m"], At(date="2020-01-02"), 0) == ids["b"]
    assert revision_at(git, folder, ids["m"], At(date="2020-01-02T11:00:00"), 0) == ids["a"]
    with pytest.raises(GitError, match="no commit before 2019-12-31; the first is of 2020-01-01"):
        revision_at(git, folder, ids["m"], At(date="2019-12-31"), 0)


def test_a_commit(git, branched):
    folder, ids = branched
    assert revision_at(git, folder, ids["m"], At(commit=ids["b"][:10]), 0) == ids["b"]
    with pytest.raises(GitError, match="no commit 0123456789"):
        revision_at(git, folder, ids["m"], At(commit="0123456789"), 0)
