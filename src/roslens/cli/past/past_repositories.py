"""The repositories whose past revisions are those of a workspace: the one that it lies in, or those that it holds."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.git.git_repository import Repository, repository_of
from roslens.model.errors import UsageError
from roslens.source.engines.watched_reader import LostReaderError, read_watched

if TYPE_CHECKING:
    from roslens.source.history.histories import ReadLog
    from roslens.source.history.past_states import RepositoryPast
    from roslens.source.settings import WorkspaceSettings


def places_of(root: Path, settings: WorkspaceSettings) -> list[str]:
    """Return the places of the repositories below a workspace's root; ``.`` alone where it lies in one.

    A workspace that lies in a repository and holds packages of that repository has its past.
    """
    from roslens.source.history.repository_head import tops_of
    from roslens.source.workspace.find import find_workspace

    tops = tops_of(found.folder for found in find_workspace([root], settings).packages)
    below = [Path(top).relative_to(root).as_posix() for top in tops if top.startswith(f"{root}/")]
    return below if below and len(below) == len(tops) else ["."]


def past_repositories(root: Path, settings: WorkspaceSettings, read: ReadLog) -> tuple[RepositoryPast, ...]:
    """Return the repositories with what is behind their heads, by place.

    Of several, one that has no past, as a shallow clone has none, is left out, and why is said on standard error.

    Args:
        root: of the workspace.
        settings: which folders count.
        read: gives the log of a repository.

    Raises:
        UsageError: no repository has a past.
    """
    places = places_of(root, settings)
    if places == ["."]:
        return (_past_of(".", repository_of(str(root)), read),)
    found = tuple(_those_with_a_past(root, places, read))
    if not found:
        raise UsageError(
            f"none of the {len(places)} repositories in {root} has past revisions that can be read",
            expected="a clone with all its commits",
            advice="Fetch them whole: roslens fetch --whole",
        )
    return found


def _those_with_a_past(root: Path, places: list[str], read: ReadLog) -> Iterator[RepositoryPast]:
    for place in places:
        try:
            yield _past_of(place, repository_of(str(root / place)), read)
        except UsageError as error:
            more = f" ({error.advice})" if error.advice else ""
            print(f"roslens: {place} is left out: {error.what}{more}", file=sys.stderr)


def _past_of(place: str, repository: Repository, read: ReadLog) -> RepositoryPast:
    from roslens.source.history.git_answer import HistoryError
    from roslens.source.history.past_states import RepositoryPast
    from roslens.source.history.repository_head import head_of

    try:
        head = head_of(repository.root)
        if not head.head:
            raise UsageError(f"{repository.root} has no commit yet", expected="a history", advice="Commit something")
        if head.is_shallow:
            raise UsageError(
                f"{repository.root} is a shallow clone: its older commits are missing",
                expected="a clone with all commits",
                advice="git fetch --unshallow",
            )
        log = read(head)
    except HistoryError as error:
        raise UsageError(
            f"the history of {repository.root} cannot be read: {error}", expected="a repository that git can read"
        ) from error
    known = {commit.id for commit in log.commits}
    released = tuple(one for one in head.releases if one.commit in known)
    return RepositoryPast(place, repository.root, repository.below, log, released)


def behind_heads(root: Path, settings: WorkspaceSettings) -> Callable[[tuple[tuple[str, str], ...]], bool] | None:
    """Return whether commits, by place of their repository, are what the heads of today came from.

    They are not after a forced push, and where the workspace holds other repositories now. None if unknown.
    """
    try:
        places = read_watched(str(root), places_of, root, settings)
        known = {place: _commits_behind(root / place) for place in places}
    except (UsageError, LostReaderError):
        return None

    def is_behind(commits: tuple[tuple[str, str], ...]) -> bool:
        return {place for place, _ in commits} <= known.keys() and all(
            not commit or (behind := known[place]) is None or commit in behind for place, commit in commits
        )

    return is_behind


def _commits_behind(folder: Path) -> frozenset[str] | None:
    done = repository_of(str(folder)).git("rev-list", "HEAD")
    return frozenset(done.stdout.decode("ascii", "replace").split()) if done.returncode == 0 else None
