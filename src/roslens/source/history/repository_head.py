"""The repositories that a workspace is made of, and where each of them stands."""

from __future__ import annotations

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

import msgspec

from roslens.children.git import looks_bare
from roslens.intake.bounded_file import read_bounded
from roslens.model.process import Release
from roslens.source.history.git_answer import HistoryError, git_answer
from roslens.source.history.metrics.releases import is_release
from roslens.source.history.partial_clone import is_partial
from roslens.source.keys import content_hash


class RepositoryHead(msgspec.Struct, frozen=True):
    """A repository as it stands.

    Attributes:
        top: folder of its work tree.
        head: the commit that is checked out; empty where there is none yet.
        is_shallow: whether older commits are missing.
        is_partial: whether contents of files, or lists of them, may be missing.
        releases: all tags that name versions, whether behind the head or not.
        mailmap: hash of ``.mailmap``; empty for none.
        attributes: hash of git's ``info/attributes``, which says what is text; empty for none.
    """

    top: str
    head: str
    is_shallow: bool
    is_partial: bool
    releases: tuple[Release, ...]
    mailmap: str
    attributes: str = ""


def tops_of(folders: Iterable[str]) -> list[str]:
    """Return the folders of the repositories that these folders are in, sorted; a folder in none has none."""
    known: dict[str, str] = {}

    def top(folder: str) -> str:
        if folder not in known:
            above = os.path.dirname(folder)  # noqa: PTH120 - thousands of times
            here = os.path.lexists(os.path.join(folder, ".git"))  # noqa: PTH118 - thousands of times
            known[folder] = folder if here else "" if above == folder else top(above)
        return known[folder]

    return sorted({found for folder in folders if (found := top(os.path.abspath(folder)))})  # noqa: PTH100 - text


def head_of(top: str) -> RepositoryHead:
    """Return where a repository stands.

    Raises:
        HistoryError: git cannot read it.
    """
    if bare := looks_bare(top):
        raise HistoryError(f'"{bare}" looks like a bare git repository, whose configuration is not trusted')
    shallow = git_answer(top, "rev-parse", "--is-shallow-repository").strip() == b"true"
    try:
        head = git_answer(top, "rev-parse", "--verify", "--quiet", "HEAD^{commit}").decode("ascii", "replace").strip()
    except HistoryError:
        head = ""
    mailmap, attributes = (_hash(Path(top, path)) for path in (".mailmap", ".git/info/attributes"))
    return RepositoryHead(top, head, shallow, is_partial(top), tuple(_releases(top)), mailmap, attributes)


def _releases(top: str) -> list[Release]:
    fields = ("refname:lstrip=2", "objectname", "*objectname", "committerdate:unix", "*committerdate:unix")
    form = "%00".join(f"%({field})" for field in fields)
    found = []
    for line in (
        git_answer(top, "for-each-ref", f"--format={form}", "refs/tags").decode("utf-8", "replace").splitlines()
    ):
        name, own, peeled, own_time, peeled_time = line.split("\0")
        time_s = peeled_time or own_time
        if is_release(name) and time_s:
            found.append(Release(name, peeled or own, int(time_s)))
    return found


def _hash(path: Path) -> str:
    with suppress(OSError):
        return content_hash(read_bounded(path))
    return ""
