"""Issues of all repositories of a workspace, each from its forge; one that does not answer is a failure of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import msgspec

from roslens.model.entity import EntityId, EntityKind
from roslens.model.failure import Failure
from roslens.source.forge.forge_client import ForgeClient
from roslens.source.forge.forge_error import ForgeError
from roslens.source.forge.forge_place import Forge, place_of_url
from roslens.source.forge.issue_counts import IssueCounts, issue_counts
from roslens.source.history.git_answer import HistoryError, git_answer

Connect = Callable[[Forge], ForgeClient]


class ForgeAnswers(msgspec.Struct, frozen=True):
    """What forges reported, by folder of the repository, and what they did not."""

    counts: dict[str, IssueCounts] = {}
    failures: tuple[Failure, ...] = ()


def ask_forges(tops: Sequence[tuple[str, str]], forges: Mapping[str, Forge], connect: Connect) -> ForgeAnswers:
    """Ask for each repository.

    Args:
        tops: folder of each repository, and its place below the root of the workspace.
        forges: that may be asked, by host.
        connect: gives the client of a forge.
    """
    counts, failures = {}, []
    for top, path in tops:
        try:
            url = git_answer(top, "config", "--get", "remote.origin.url").decode("utf-8", "replace").strip()
        except HistoryError:
            failures.append(_failure(path, "it has no remote `origin`", "Add it: git remote add origin URL"))
            continue
        place = place_of_url(url, forges)
        if place is None:
            failures.append(
                _failure(
                    path,
                    f"`origin` is {_without_secret(url)!r}, on no forge that is known",
                    "Name its forge: --forge-host HOST=github, HOST=gitlab or HOST=gitea",
                )
            )
            continue
        try:
            with connect(place.forge) as client:
                counts[top] = issue_counts(client, place)
        except ForgeError as error:
            failures.append(_failure(path, error.what, error.advice))
    return ForgeAnswers(counts, tuple(failures))


def _without_secret(url: str) -> str:
    """Return an address without name and password, which do not belong into a report."""
    scheme, mark, rest = url.partition("://")
    return f"{scheme}://{rest.rpartition('@')[2]}" if mark else url


def _failure(path: str, what: str, advice: str) -> Failure:
    return Failure(
        "forge",
        f'issues of repository "{path}" are not known: {what}',
        "the numbers of its issues and requests",
        advice,
        entity=str(EntityId(EntityKind.REPOSITORY, path)),
        partial=True,
    )
