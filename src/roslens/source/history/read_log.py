"""The commits of a repository, read from git in one pass."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from hashlib import blake2b

import msgspec

from roslens.source.history.commit_log import Change, Commit, CommitLog, Rename
from roslens.source.history.git_answer import HistoryError, git_answer

_FORMAT = "--format=%x01%H%x1f%P%x1f%ct%x1f%aN%x1f%(trailers:key=Co-authored-by,valueonly,separator=%x1e,unfold)"
_PLAIN = ("--topo-order", "--no-renames", "--ignore-submodules=none", "-z")
_RENAMES = (
    "--topo-order",
    "--no-merges",
    "--ignore-submodules=none",
    "--diff-filter=R",
    "-l1000",
    "-z",
    "--format=%x01%H",
)
_CONTACT = re.compile(r"[^<>\n]*<[^<>\n]*>")


class _Raw(msgspec.Struct, frozen=True):
    id: str
    parents: tuple[str, ...]
    time_s: int
    author: str
    others: tuple[str, ...]
    changes: tuple[tuple[str, int, int], ...]


def read_log(folder: str, head: str, *, contents: bool = True) -> CommitLog:
    """Return the commits behind ``head``.

    Args:
        folder: in the work tree of the repository; its ``.mailmap`` says which names are one person.
        head: a commit.
        contents: whether the repository has all contents of files; in a partial clone lines are not counted, and
            where lists of files are missing too, no changes.

    Raises:
        HistoryError: git cannot read the history.
    """
    if contents:
        raw = list(_commits(git_answer(folder, "log", *_PLAIN, "--numstat", _FORMAT, head), _counted))
        renames = git_answer(folder, "log", *_RENAMES, "--find-renames", "--numstat", head)
        return _log(folder, raw, _renamed(renames), has_lines=True, has_changes=True)
    try:
        raw = list(_commits(git_answer(folder, "log", *_PLAIN, "--raw", "--no-abbrev", _FORMAT, head), _named))
        # Of contents that are not there only whether they are the same is known.
        renames = git_answer(folder, "log", *_RENAMES, "--find-renames=100%", "--name-status", head)
        return _log(folder, raw, _renamed(renames), has_lines=False, has_changes=True)
    except HistoryError:
        raw = list(_commits(git_answer(folder, "log", *_PLAIN, "--no-patch", _FORMAT, head), _named))
        return _log(folder, raw, {}, has_lines=False, has_changes=False)


Row = tuple[str, int, int]
"""Path, lines added, lines deleted."""


def _commits(answer: bytes, rows: Callable[[list[bytes]], Iterator[Row]]) -> Iterator[_Raw]:
    header: list[str] = []
    pieces: list[bytes] = []
    for piece in answer.split(b"\0"):
        if piece.startswith(b"\x01"):
            if header:
                yield _raw(header, tuple(rows(pieces)))
            header, pieces = piece[1:].decode("utf-8", "replace").split("\x1f", 4), []
        elif piece.strip(b"\n"):
            pieces.append(piece.removeprefix(b"\n"))
    if header:
        yield _raw(header, tuple(rows(pieces)))


def _raw(header: list[str], changes: tuple[Row, ...]) -> _Raw:
    if len(header) != 5:
        raise HistoryError(f"git log answers in a form that is not known: {header[0][:60]!r}")
    name, parents, time_s, author, others = header
    named = (one.strip() for one in others.split("\x1e"))
    return _Raw(name, tuple(parents.split()), int(time_s or 0), author, tuple(filter(None, named)), changes)


def _counted(pieces: list[bytes]) -> Iterator[Row]:
    """Yield the content of ``--numstat``; a binary file has ``-`` for its lines."""
    for piece in pieces:
        added, deleted, path = piece.split(b"\t", 2)
        yield path.decode("utf-8", "replace"), _number(added), _number(deleted)


def _named(pieces: list[bytes]) -> Iterator[Row]:
    """Yield the content of ``--raw``: modes, hashes and a letter, then the path."""
    for path in pieces[1::2]:
        yield path.decode("utf-8", "replace"), 0, 0


Renamed = tuple[str, str, int, int]
"""Path before, path afterwards, lines added, lines deleted."""


def _renamed(answer: bytes) -> dict[str, list[Renamed]]:
    """Return the renames of each commit, by its hash.

    Each is a row of ``--numstat`` without a path, or the letter of ``--name-status``, and two paths.
    """
    found: dict[str, list[Renamed]] = {}
    pieces = iter(answer.split(b"\0"))
    rows: list[Renamed] = []
    for piece in pieces:
        if piece.startswith(b"\x01"):
            rows = found.setdefault(piece[1:].decode("ascii", "replace").strip(), [])
        elif facts := piece.strip(b"\n"):
            old, new = (next(pieces, b"").decode("utf-8", "replace") for _ in range(2))
            added, _, deleted = facts.partition(b"\t")
            rows.append((old, new, _number(added), _number(deleted.strip())))
    return found


def _number(text: bytes) -> int:
    return int(text) if text.isdigit() else 0


def _log(
    folder: str, raw: list[_Raw], renamed: dict[str, list[Renamed]], *, has_lines: bool, has_changes: bool
) -> CommitLog:
    of_contact = _mapped(folder, sorted({one for commit in raw for one in commit.others}))
    people: dict[str, int] = {}
    paths: dict[str, int] = {}
    commits = []
    for commit in raw:
        names = dict.fromkeys((commit.author, *(of_contact[one] for one in commit.others)))
        who = tuple(people.setdefault(_person(name), len(people)) for name in names)
        changes = tuple(Change(paths.setdefault(path, len(paths)), added, gone) for path, added, gone in commit.changes)
        renames = tuple(
            Rename(paths.setdefault(old, len(paths)), paths.setdefault(new, len(paths)), added, gone)
            for old, new, added, gone in renamed.get(commit.id, ())
        )
        commits.append(Commit(commit.id, commit.parents, commit.time_s, who, changes, renames))
    return CommitLog(tuple(commits), tuple(paths), tuple(people), has_lines, has_changes)


def _person(name: str) -> str:
    """Return a token for a person: only whether two are the same matters here, not who it is."""
    return blake2b(name.encode("utf-8", "replace"), digest_size=8).hexdigest()


def _mapped(folder: str, contacts: list[str]) -> dict[str, str]:
    """Return the name that ``.mailmap`` gives to each ``Name <address>``."""
    plain = [one for one in contacts if _CONTACT.fullmatch(one)]
    found = {one: one for one in contacts} | {one: _name(one) for one in plain}
    if plain:
        given = "".join(f"{one}\n" for one in plain).encode("utf-8", "replace")
        try:
            said = git_answer(folder, "check-mailmap", "--stdin", given=given).decode("utf-8", "replace").split("\n")
        except HistoryError:
            # One that git cannot read among them: they stay as they are written.
            return found
        found.update({one: _name(line) for one, line in zip(plain, said, strict=False)})
    return found


def _name(contact: str) -> str:
    return contact.partition("<")[0].strip()
