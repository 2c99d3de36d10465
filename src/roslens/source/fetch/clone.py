"""One repository, cloned into a folder of its own: whole or not at all.

A clone is made beside and renamed into its place once it is complete, so that a folder that is there is one that is
finished, whatever ended the last attempt.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import msgspec

from roslens.children.fetching_git import ATTRIBUTES, CONFIGURATION
from roslens.intake.bounded_file import read_bounded
from roslens.intake.is_there import is_file
from roslens.model.words.plural import plural
from roslens.source.fetch.at import At, revision_at
from roslens.source.fetch.git_runner import GitError, GitRunner, PrintedTooMuchError
from roslens.source.fetch.index_entries import Entries, IndexFormatError, index_entries
from roslens.source.fetch.lacking_files import write_files
from roslens.source.fetch.leaving_links import remove_leaving
from roslens.source.fetch.new_clone import begin_clone, set_head
from roslens.source.fetch.refs import Ref, is_commit, is_ref_name, is_unknown_ref, ref_of
from roslens.source.fetch.submodules import Submodule, SubmoduleSettings, submodules_of
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
        submodules: where submodules come from; None to leave them out.
    """

    wanted: Wanted
    url: str
    at: At
    depth: int = 0
    whole: bool = False
    submodules: SubmoduleSettings | None = None

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
        begin_clone(part, request.url)
        tip = _fetch(git, request, part)
        taken = _set_to(git, request, part, _wanted_of(git, request, part, tip), How.FETCHED)
        _take_submodules(git, request, part)
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
    before = head_of(git, place)
    tip = _fetch(git, request, place)
    found = _wanted_of(git, request, place, tip)
    if found.commit == before:
        _take_submodules(git, request, place)
        return _described(request, place, found, How.KEPT, _entries(place))
    taken = _set_to(git, request, place, found, How.UPDATED)
    _take_submodules(git, request, place)
    # Only an available history can decide that.
    if not request.depth and git.ask(folder, "merge-base", "--is-ancestor", before, found.commit) is None:
        forced = f"its history was rewritten: {before[:12]}, which was here, is not behind {found.commit[:12]}"
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
    notes = _about_submodules(request, _entries(place))
    return msgspec.structs.replace(locked, how=How.KEPT, notes=notes, failure="")


def described(git: GitRunner, request: Request, place: Path, how: How) -> Taken:
    """Return what is in a clone now.

    Raises:
        GitError: git cannot tell.
        OSError: its files cannot be read.
    """
    return _described(request, place, _tip(git, place, "HEAD"), how, _entries(place))


class _Tip(msgspec.Struct, frozen=True):
    """A commit, on which day it was committed, and how many there are behind it and with it."""

    commit: str
    day: str
    commits: int


def _tip(git: GitRunner, place: Path, name: str) -> _Tip:
    """Return the commit of a name; of a part of a history commits are not counted."""
    folder, whole = str(place), not is_file(place / ".git" / "shallow")
    words = ("rev-list", "--format=%cI", name)
    commits = 0
    try:
        rows = git.do(folder, *words, *(() if whole else ("-1",))).split()
        commits = len(rows) // 3 if whole else 0
    except PrintedTooMuchError:
        # A million commits and more.
        rows = git.do(folder, *words, "-1").split()
        commits = int(git.do(folder, "rev-list", "--count", name))
    if not rows:
        raise GitError(f"{name} names no commit")
    return _Tip(rows[1], rows[2], commits)


def _wanted_of(git: GitRunner, request: Request, place: Path, tip: str) -> _Tip:
    """Return the revision that is asked for behind a tip."""
    if request.at == At():
        return _tip(git, place, tip)
    return _tip(git, place, revision_at(git, str(place), tip, request.at, request.count))


def _described(request: Request, place: Path, tip: _Tip, how: How, entries: Entries) -> Taken:
    notes = [*_about_submodules(request, entries)]
    if is_file(place / ".git" / "shallow") and not request.depth:
        notes.append("the server has only a part of the history, so that nothing is counted in it")
    return Taken(
        request.wanted,
        how,
        request.at.text(),
        tip.commit,
        tip.commits,
        tip.day,
        request.depth,
        request.whole,
        tuple(notes),
        submodules=request.submodules is not None,
    )


def _entries(place: Path) -> Entries:
    try:
        return index_entries(place)
    except IndexFormatError as error:
        raise GitError(str(error)) from error


def _about_submodules(request: Request, entries: Entries) -> tuple[str, ...]:
    found = entries.submodules
    if not found or request.submodules is not None:
        return ()
    many = plural(len(found), "submodule is", "submodules are")
    return (f"{many} not fetched, the first at {found[0][0]}; `--submodules` fetches them",)


def _take_submodules(git: GitRunner, request: Request, place: Path) -> None:
    """Have the submodules of a checkout at the commits that it records; without one of them it is not whole."""
    settings = request.submodules
    if settings is None:
        return
    inner = msgspec.structs.replace(settings, level=settings.level + 1)
    for one in submodules_of(git, place, request.url, _entries(place), settings):
        wanted = Wanted(one.path, one.url, one.commit)
        asked = Request(wanted, one.url, At(), request.depth, request.whole, inner)
        try:
            _take_submodule(git, asked, one, place)
        except GitError as error:
            raise GitError(f"the submodule at {one.path}: {error}") from error


def _take_submodule(git: GitRunner, request: Request, submodule: Submodule, place: Path) -> None:
    folder = place / submodule.path
    if (folder / ".git").is_dir():
        refuse_strange(git, folder, request.url)
        if head_of(git, folder) != submodule.commit:
            update(git, request, folder)
        return
    clone(git, request, folder, place / ".git" / "part")


def _fetch(git: GitRunner, request: Request, place: Path) -> str:
    """Fetch what is wanted of the server and return the name of the commit that it has now."""
    folder, version = str(place), request.wanted.version
    if is_commit(version) and (found := _known(git, folder, version)):
        return found
    if version and not is_commit(version) and is_ref_name(version):
        # A branch, as nearly always: the server need not be asked first what it calls a tag.
        try:
            _take(git, request, folder, f"+refs/heads/{version}:refs/remotes/origin/{version}")
        except GitError as error:
            if not is_unknown_ref(str(error)):
                raise
        else:
            return f"refs/remotes/origin/{version}"
    ref = ref_of(git, folder, request.url, version)
    if ref.name:
        _take(git, request, folder, f"+{ref.name}:{_tracking(ref)}")
        return f"{_tracking(ref)}^{{commit}}"
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
    return f"{ref.id}^{{commit}}"


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


def _set_to(git: GitRunner, request: Request, place: Path, tip: _Tip, how: How) -> Taken:
    """Write the files of a commit, fetching their content where it is not here yet."""
    folder = str(place)
    set_head(place, tip.commit)
    lacking = write_files(git, folder, tip.commit, local=is_local(request.url))
    entries = _entries(place)
    gone = remove_leaving(place, entries.links)
    taken = _described(request, place, tip, how, entries)
    notes = list(taken.notes)
    if lacking:
        notes.append(f"the server lacks the content of {_files(len(lacking))}, first {lacking[0]}; none is a source")
    if gone:
        git.do(folder, "update-index", "--skip-worktree", "--", *gone)
        notes.append(f"{len(gone)} links that lead out of the repository are left out, the first at {gone[0]}")
    return msgspec.structs.replace(taken, notes=tuple(notes))


def _files(number: int) -> str:
    return "1 file" if number == 1 else f"{number} files"
