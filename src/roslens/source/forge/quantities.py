"""What is measured of a repository on its forge."""

from __future__ import annotations

from roslens.model.entity import EntityKind
from roslens.model.quantity import Better, Quantity

_SOURCE = "Santos et al., A Framework for Quality Assessment of ROS Repositories, IROS 2016 ({}, with requests)"
_LIMITS = (
    "Measured only with `--forge`, when the run is made: the same commit has other numbers on another day. Where a "
    "repository keeps its issues elsewhere, it has none."
)

_GITHUB = "GitHub: `search/issues?q=repo:R type:{} state:open`"

_ROWS = (
    (
        "open_issues",
        "Open issues",
        "How many issues are open on the forge; pull requests are none.",
        f"{_GITHUB.format('issue')}; GitLab: `issues_statistics`; Gitea: `issues?type=issues&state=open`",
        _SOURCE.format("#OI"),
    ),
    (
        "closed_issues",
        "Closed issues",
        "How many issues were closed; pull requests are none.",
        "as `open_issues`, with state closed",
        _SOURCE.format("#CI"),
    ),
    (
        "open_requests",
        "Open pull requests",
        "How many pull or merge requests are open.",
        f"{_GITHUB.format('pr')}; GitLab: `merge_requests?state=opened`; Gitea: `issues?type=pulls&state=open`",
        "plain count",
    ),
    (
        "closed_requests",
        "Closed pull requests",
        "How many pull or merge requests were merged or closed.",
        "as `open_requests`, with states closed, locked and merged",
        "plain count",
    ),
)

FORGE_QUANTITIES = {
    key: Quantity(
        key=key,
        title=title,
        unit=key.partition("_")[2],
        kinds=(EntityKind.REPOSITORY,),
        text=text,
        better=Better.NEITHER,
        formula=formula,
        source=source,
        limits=_LIMITS,
    )
    for key, title, text, formula, source in _ROWS
}
"""By key."""
