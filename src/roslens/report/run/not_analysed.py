"""Which failures of a run leave out something of what is judged."""

from __future__ import annotations

from roslens.model.failure import Failure
from roslens.model.graphs.completeness import INCOMPLETE
from roslens.model.source import Role
from roslens.store.read import RunView

MANIFEST = "manifest"
"""Tool of what a manifest should say otherwise, which leaves nothing out; runs of older versions have it."""


def not_analysed(view: RunView, *, accept_partial: bool) -> tuple[Failure, ...]:
    """Return the failures because of which a check is not clean.

    What a manifest should say otherwise leaves nothing out, what is unknown of a computation graph is reported and no
    more, as most workspaces start nodes of others, and a place that does not parse in code of others, in a
    test or in what was generated is none of what is judged.

    Args:
        view: the run.
        accept_partial: whether files that were analysed in part pass.
    """
    failures = tuple(failure for failure in view.failures() if failure.tool != INCOMPLETE)
    partial = [failure for failure in failures if failure.partial and failure.tool != MANIFEST]
    own = set()
    if partial and not accept_partial:
        own = {file.path for _, file in view.files() if file.role is Role.OWN}
    return tuple(
        failure
        for failure in failures
        if not failure.partial
        or (
            not accept_partial
            and failure.tool != MANIFEST
            and (failure.tool != "syntax" or failure.location is None or failure.location.path in own)
        )
    )
