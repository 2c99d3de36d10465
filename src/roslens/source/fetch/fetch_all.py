"""All repositories that are wanted, several at a time; each ends as fetched, kept, updated or failed."""

from __future__ import annotations

import os
import shutil
from collections.abc import Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from pathlib import Path

import msgspec

from roslens.intake.held_signals import held_signals
from roslens.source.fetch.at import At, revision_at
from roslens.source.fetch.clone import (
    Request,
    clone,
    described,
    head_of,
    own_attributes,
    refuse_strange,
    still_there,
    update,
)
from roslens.source.fetch.folder_name import is_folder_name
from roslens.source.fetch.git_runner import GitError, GitRunner
from roslens.source.fetch.journal import Journal, alone
from roslens.source.fetch.retry import Retry
from roslens.source.fetch.submodules import SubmoduleSettings
from roslens.source.fetch.taken import How, Taken
from roslens.source.fetch.urls import UrlError, checked, is_local, rewritten
from roslens.source.fetch.wanted import Wanted
from roslens.source.progress import Progress

JOBS = 4
"""Repositories at once: more make a server of one host refuse some."""

_PARTS = "parts"


class FetchOptions(msgspec.Struct, frozen=True):
    """How repositories are fetched.

    Attributes:
        at: which revision of each.
        depth: commits of history; 0 for all.
        whole: whether the content of past revisions comes too, and not only what happened when.
        update: whether branches are asked again where a commit is there or in the lock.
        offline: whether servers are not asked.
        files: whether the document may name folders of this machine.
        rewrites: prefixes of URLs, and what takes their place.
        jobs: repositories at once.
        submodules: whether submodules come too, each at the commit that its repository records.
    """

    at: At = At()
    depth: int = 0
    whole: bool = False
    update: bool = False
    offline: bool = False
    files: bool = True
    rewrites: Mapping[str, str] = {}
    jobs: int = JOBS
    submodules: bool = False


def fetch_all(
    wanted: Sequence[Wanted], into: Path, state: Path, options: FetchOptions, *, retry: Retry, progress: Progress
) -> list[Taken]:
    """Have the repositories below ``into`` and return what became of each, in their order.

    What an earlier attempt finished is kept, whatever ended it. The lock in ``into`` is written at the end.

    Args:
        wanted: the repositories, no name twice.
        into: the folder that they come to.
        state: a folder of roslens' own on the same file system.
        options: how.
        retry: what is done when the network breaks.
        progress: who watches.

    Raises:
        UsageError: another process fetches into the folder, or its lock cannot be read.
        OSError: the folder cannot be written.
    """
    state.mkdir(parents=True, exist_ok=True)
    into, state = into.resolve(), state.resolve()
    with alone(state):
        shutil.rmtree(state / _PARTS, ignore_errors=True)
        journal = Journal(into, state)
        known = journal.known()
        git = GitRunner(retry)
        progress.step("Fetching repositories", len(wanted))
        done: dict[str, Taken] = {}

        def one(repository: Wanted, number: int) -> Taken:
            part = state / _PARTS / str(number)
            taken = _one(git, repository, into / repository.name, part, known.get(repository.name), options)
            journal.note(taken)
            return taken

        pool = ThreadPoolExecutor(max(1, options.jobs), thread_name_prefix="fetch")
        try:
            with held_signals():
                futures: dict[Future[Taken], str] = {
                    pool.submit(one, repository, number): repository.name for number, repository in enumerate(wanted)
                }
            for future in as_completed(futures):
                taken = future.result()
                done[taken.wanted.name] = taken
                progress.advance(item=taken.wanted.name)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            git.end_all()
            raise
        finally:
            pool.shutdown(wait=True, cancel_futures=True)
        journal.close({**{name: taken for name, taken in known.items() if (into / name).exists()}, **done})
        return [done[repository.name] for repository in wanted]


def _one(git: GitRunner, wanted: Wanted, place: Path, part: Path, before: Taken | None, options: FetchOptions) -> Taken:
    asked = options.at.text()
    try:
        request = _request(wanted, options)
        locked = before if before and _answers(before, wanted, options) else None
        taken = _had(git, request, place, part, locked, options)
    except (GitError, UrlError, OSError) as error:
        # What an earlier attempt left stays, and stays known.
        commit = before.commit if before and os.path.lexists(place) else ""
        return Taken(
            wanted, How.FAILED, asked, commit, depth=options.depth, whole=options.whole, failure=_words(error),
            submodules=options.submodules,
        )  # fmt: skip
    # A lock's commit is a way to what was asked for; the lock goes on saying what that was.
    return msgspec.structs.replace(taken, wanted=wanted, at=asked)


def _answers(before: Taken, wanted: Wanted, options: FetchOptions) -> bool:
    return before.answers(wanted, options.at.text(), options.depth, whole=options.whole, submodules=options.submodules)


def _request(wanted: Wanted, options: FetchOptions) -> Request:
    """Return what git is asked for.

    Raises:
        UrlError: nothing can be asked for.
    """
    if not is_folder_name(wanted.name):
        raise UrlError(f"the name {wanted.name!r} is not a folder name")
    if wanted.kind != "git":
        raise UrlError(_way_round(wanted))
    if options.at.counted and not wanted.commits:
        raise UrlError("the filter has no number of commits for it")
    url = rewritten(wanted.url, options.rewrites)
    url = checked(url, files=options.files or url != wanted.url)
    settings = SubmoduleSettings(options.rewrites, options.files) if options.submodules else None
    return Request(wanted, url, options.at, options.depth, options.whole, settings)


def _way_round(wanted: Wanted) -> str:
    convert = {
        "hg": "`hg-fast-export`, or `git clone hg::URL` of git-remote-hg",
        "svn": f"`git svn clone {wanted.url}`",
        "tar": "`git init` in the unpacked archive",
    }.get(wanted.kind, "a conversion")
    return (
        f"repositories of the type {wanted.kind!r} are not fetched; make a git repository of it ({convert}) and give "
        "its place in roslens.toml, [fetch.rewrite]"
    )


def _had(
    git: GitRunner, request: Request, place: Path, part: Path, locked: Taken | None, options: FetchOptions
) -> Taken:
    if os.path.lexists(place):
        if options.update and not (options.offline and not is_local(request.url)):
            return update(git, request, place)
        return _kept(git, request, place, locked, options)
    if options.offline and not is_local(request.url):
        raise GitError("it is not available locally, and --offline allows no download")
    if locked is not None and not options.update:
        exact = msgspec.structs.replace(request.wanted, version=locked.commit)
        return clone(git, msgspec.structs.replace(request, wanted=exact, at=At()), place, part)
    return clone(git, request, place, part)


def _kept(git: GitRunner, request: Request, place: Path, locked: Taken | None, options: FetchOptions) -> Taken:
    """Return what is there if it is what is wanted; what another request left is brought to this one."""
    refuse_strange(git, place, request.url)
    own_attributes(place)
    head = head_of(git, place)
    if locked is not None:
        if head == locked.commit:
            return still_there(git, request, place, locked)
        raise GitError(f"it is at {head[:12]}, but the lock requires {locked.commit[:12]}; `--update` brings it there")
    if options.offline and not is_local(request.url):
        at = revision_at(git, str(place), head, request.at, request.count)
        if at == head:
            return described(git, request, place, How.KEPT)
        raise GitError("another revision of it is required, and --offline allows no download")
    return update(git, request, place)


def _words(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename else error.strerror
    return str(error)
