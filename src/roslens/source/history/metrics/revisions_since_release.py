"""Number of commits since the last release."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.model.entity import EntityKind
from roslens.model.process import Release
from roslens.model.quantity import Better, Quantity
from roslens.source.history.commit_log import CommitLog, behind

QUANTITY = Quantity(
    key="revisions_since_release",
    title="Revisions since the last release",
    unit="commits",
    kinds=(EntityKind.REPOSITORY,),
    text="How many commits are not in any release yet.",
    better=Better.NEITHER,
    formula="number of commits behind the head that are not behind the newest release; releases as in `releases`",
    source="plain count",
    limits="The newest release is the one whose commit comes first from the head; absent without a release.",
)

COMMANDS = {"repository": "git rev-list --count HEAD ^TAG"}


def of_log(log: CommitLog, releases: Iterable[Release]) -> float | None:
    """Return the number of commits; None without a release."""
    tagged = {one.commit for one in releases}
    newest = next((commit.id for commit in log.commits if commit.id in tagged), None)
    return None if newest is None else len(log.commits) - len(behind(log, newest).commits)
