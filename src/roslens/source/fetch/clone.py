"""One repository, cloned into a folder of its own: whole or not at all.

A clone is made beside and renamed into its place once it is complete, so that a folder that is there is one that is
finished, whatever ended the last attempt.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import msgspec

from roslens.children.fetching_git import ATTRIBUTES, CONFIGURATION
from roslens.intake.bounded_file import read_bounded
from roslens.intake.is_there import is_file
from roslens.source.fetch.at import At, revision_at
from roslens.source.fetch.git_runner import GitError, GitRunner
from roslens.source.fetch.lacking_files import write_files
from roslens.source.fetch.leaving_links import remove_leaving
from roslens.source.fetch.refs import Ref, is_commit, ref_of
from roslens.source.fetch.taken import How, Taken
from roslens.source.fetch.urls import is_local
from roslens.source.fetch.wanted import Wanted

_FOUND = "refs/roslens/found"
_LONGEST_HEAD = 4096


class Request(msgspec.Struct, frozen=True):
    """How a repository is wanted.

    Attributes:
        wanted: the repository.
        url: from which it is fetched: that of ``wanted``, checked and rewritten.
        at: which revision.
        depth: how many commits of history; 0 for all.
        whole: whether the content of past revisions comes too.
    """

    wanted: Wanted
    url: str
    at: At
    depth: int = 0
    whole: bool = False

    @property
    def count(self) -> int:
        """How many commits the revision has behind it; 0 where that is not asked for."""
        return self.at.count_of(self.wanted)


def clone(git: GitRunner, request: Request, place: Path, part: Path) -> Taken:
    """Clone a repository into ``place``, which is not there yet.

    Args:
        git: does it.
        request: what is wanted.
        place: the folder that the clone comes to.
        part: a folder beside, on the same file system, in which it is made.

    Raises:
        GitError: it cannot be had; ``place`` is not there.
        OSError: a folder cannot be written.
    """
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    try:
        _begin(git, request, part)
        tip = _fetch(git, request, str(part))
        taken = _set_to(git, request, part, revision_at(git, str(part), tip, request.at, request.count), How.FETCHED)
        place.parent.mkdir(parents=True, exist_ok=True)
        part.rename(place)
        return taken
    finally:
        shutil.rmtree(part, ignore_errors=True)


def update(git: GitRunner, request: Request, place: Path) -> Taken:
    """Bring a clone that roslens made to the revision that is wanted now.

    Raises:
        GitError: it was changed, or is not roslens' own, or the server has no such revision; nothing is lost.
    """
    folder = str(place)
    refuse_strange(git, place, request.url)
    own_attributes(place)
    if git.ask(folder, "diff-index", "--quiet", "HEAD") is None:
        raise GitError("files in it were changed; keep them elsewhere, and remove the folder")
    before = git.do(folder, "rev-parse", "HEAD").strip()
    tip = _fetch(git, request, folder)
    commit = revision_at(git, folder, tip, request.at, request.count)
    if commit == before:
        return described(git, request, place, How.KEPT)
    taken = _set_to(git, request, place, commit, How.UPDATED)
    # Only an available history can decide that.
    if not request.depth and git.ask(folder, "merge-base", "--is-ancestor", before, commit) is None:
        forced = f"its history was rewritten: {before[:12]}, which was here, is not behind {commit[:12]}"
        return msgspec.structs.replace(taken, notes=(forced, *taken.notes))
    return taken


def refuse_strange(git: GitRunner, place: Path, url: str) -> None:
    """Refuse a folder that roslens did not clone from ``url``: its configuration may start programs.

    Raises:
        GitError: it did not.
    """
    if not is_file(place / ".git" / "config"):
        raise GitError("the folder already exists, and is not a clone; remove or rename it")
    reported = git.ask(str(place), "config", "--file", str(place / ".git" / "config"), "--list", "-z") or ""
    pairs = dict(entry.partition("\n")[::2] for entry in reported.split("\0") if entry)
    if strange := sorted(pairs.keys() - CONFIGURATION):
        raise GitError(f'the folder already exists, and its configuration has "{strange[0]}"; remove or rename it')
    if pairs.get("remote.origin.url") != url:
        raise GitError(
            f"the folder already exists, as a clone of {pairs.get('remote.origin.url', 'nothing')}; remove it"
        )


def own_attributes(place: Path) -> None:
    """Give a clone that roslens made the attributes of a new one.

    Raises:
        OSError: they cannot be written.
    """
    written = place / ".git" / "info" / "attributes"
    if not is_file(written) or read_bounded(written, _LONGEST_HEAD) != ATTRIBUTES.encode():
        written.parent.mkdir(exist_ok=True)
        written.write_text(ATTRIBUTES)


def head_of(git: GitRunner, place: Path) -> str:
    """Return the commit that a clone is at; asking git, if its file does not contain it, takes longest of all.

    Raises:
        GitError: git cannot tell.
    """
    try:
        reported = read_bounded(place / ".git" / "HEAD", _LONGEST_HEAD).decode("ascii").strip()
    except (OSError, UnicodeDecodeError):
        reported = ""
    return reported if is_commit(reported) else git.do(str(place), "rev-parse", "HEAD").strip()


def still_there(git: GitRunner, request: Request, place: Path, locked: Taken) -> Taken:
    """Return what is in a clone that is at the commit of its lock: what is behind a commit is not counted again.

    Raises:
        GitError: git cannot tell.
    """
    if not locked.commits or not locked.day or is_file(place / ".git" / "shallow"):
        return described(git, request, place, How.KEPT)
    notes = _about_submodules(git, str(place))
    return msgspec.structs.replace(locked, how=How.KEPT, notes=notes, failure="")


def described(git: GitRunner, request: Request, place: Path, how: How) -> Taken:
    """Return what is in a clone now.

    Raises:
        GitError: git cannot tell.
    """
    folder = str(place)
    notes = [*_about_submodules(git, folder)]
    shallow = git.do(folder, "rev-parse", "--is-shallow-repository").strip() == "true"
    if shallow and not request.depth:
        notes.append("the server has only a part of the history, so that nothing is counted in it")
    commits = 0 if shallow else int(git.do(folder, "rev-list", "--count", "HEAD"))
    commit, day = git.do(folder, "rev-list", "-1", "--format=%cI", "HEAD").removeprefix("commit ").split()
    wanted = request.wanted
    return Taken(wanted, how, request.at.text(), commit, commits, day, request.depth, request.whole, tuple(notes))


def _about_submodules(git: GitRunner, folder: str) -> tuple[str, ...]:
    rows = git.do(folder, "ls-tree", "-r", "-z", "HEAD").split("\0")
    submodules = [row.partition("\t")[2] for row in rows if row.startswith("160000 ")]
    return (f"{len(submodules)} submodules are not fetched, the first at {submodules[0]}",) if submodules else ()


def _begin(git: GitRunner, request: Request, part: Path) -> None:
    folder = str(part)
    git.do(folder, "init", "--quiet", "--template=")
    own_attributes(part)
    git.do(folder, "config", "remote.origin.url", request.url)
    git.do(folder, "config", "remote.origin.fetch", "+refs/heads/*:refs/remotes/origin/*")


def _fetch(git: GitRunner, request: Request, folder: str) -> str:
    """Fetch what is wanted of the server and return the commit that it has now."""
    version = request.wanted.version
    if is_commit(version) and (found := _known(git, folder, version)):
        return found
    ref = ref_of(git, folder, request.url, version)
    if ref.name:
        _take(git, request, folder, f"+{ref.name}:{_tracking(ref)}")
        return git.do(folder, "rev-parse", "--verify", f"{_tracking(ref)}^{{commit}}").strip()
    try:
        _take(git, request, folder, f"+{ref.id}:{_FOUND}")
    except GitError:
        # A server may give only what its branches and tags name.
        _take(git, request, folder, "+refs/heads/*:refs/remotes/origin/*", "+refs/tags/*:refs/tags/*")
        if not _known(git, folder, ref.id):
            raise GitError(
                f"the server has no commit {ref.id[:12]} any more: its history was rewritten, or it is another "
                "repository; `--update` fetches what it has now"
            ) from None
    return git.do(folder, "rev-parse", "--verify", f"{ref.id}^{{commit}}").strip()


def _known(git: GitRunner, folder: str, commit: str) -> str:
    return (git.ask(folder, "rev-parse", "--verify", "--quiet", f"{commit}^{{commit}}") or "").strip()


def _tracking(ref: Ref) -> str:
    kind, _, name = ref.name.removeprefix("refs/").partition("/")
    return f"refs/remotes/origin/{name}" if kind == "heads" else f"refs/tags/{name}"


def _take(git: GitRunner, request: Request, folder: str, *refs: str) -> None:
    options = ["--quiet", "--no-write-fetch-head", "--no-recurse-submodules", "--force", "--update-shallow"]
    if request.depth:
        options += [f"--depth={request.depth}", "--no-tags"]
    whole = request.whole or _is_shallow(request.url)
    lacks = whole and git.ask(folder, "config", "remote.origin.promisor") is not None
    options += ["--no-filter", "--refetch"] if lacks else [] if whole else ["--filter=blob:none"]
    git.over_network(folder, "fetch", *options, "origin", *refs, local=is_local(request.url))
    if lacks:
        for key in ("remote.origin.promisor", "remote.origin.partialclonefilter", "extensions.partialclone"):
            git.ask(folder, "config", "--unset", key)


def _is_shallow(url: str) -> bool:
    """Return whether a folder of this machine has a part of a history, of which git cannot take a part again."""
    return is_local(url) and any(is_file(f"{url.removeprefix('file://')}{inner}/shallow") for inner in ("", "/.git"))


def _set_to(git: GitRunner, request: Request, place: Path, commit: str, how: How) -> Taken:
    """Write the files of a commit, fetching their content where it is not here yet."""
    folder = str(place)
    git.do(folder, "update-ref", "--no-deref", "HEAD", commit)
    lacking = write_files(git, folder, commit, local=is_local(request.url))
    rows = git.do(folder, "ls-tree", "-r", "-z", commit).split("\0")
    links = [row.partition("\t")[2] for row in rows if row.startswith("120000 ")]
    gone = remove_leaving(place, map(os.fspath, links))
    taken = described(git, request, place, how)
    notes = list(taken.notes)
    if lacking:
        notes.append(f"the server lacks the content of {_files(len(lacking))}, first {lacking[0]}; none is a source")
    if gone:
        git.do(folder, "update-index", "--skip-worktree", "--", *gone)
        notes.append(f"{len(gone)} links that lead out of the repository are left out, the first at {gone[0]}")
    return msgspec.structs.replace(taken, notes=tuple(notes))


def _files(number: int) -> str:
    return "1 file" if number == 1 else f"{number} files"
