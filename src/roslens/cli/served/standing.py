"""How a run stands to its gate and to the run before, for the pages that show it."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from roslens.dashboard.since_run import SinceRun
from roslens.store.runs import StoredRun

if TYPE_CHECKING:
    from roslens.dashboard.gate_line import GateLine
    from roslens.dashboard.site import Site
    from roslens.store.read import RunView


class Kept(msgspec.Struct, frozen=True):
    """The ``runs`` that are kept, none where there is one only, and the one that is shown against that before it."""

    runs: tuple[StoredRun, ...] = ()
    since: SinceRun | None = None


@contextmanager
def kept_runs(options: argparse.Namespace, view: RunView) -> Iterator[Kept]:
    """Yield what is kept besides a run."""
    from roslens.cli.workplace.workplace import open_store

    if options.no_store or options.changed:
        yield Kept()
        return
    with open_store(options.path) as store:
        runs = store.runs()
        earlier = max((one.id for one in runs if one.id < view.id), default=None)
        since = None
        if earlier is not None:
            before = store.view(earlier)
            since = SinceRun(f"run {earlier}", lambda: tuple(before.findings()), lambda: tuple(view.findings()))
        yield Kept(runs if len(runs) > 1 else (), since)


def gate_of(site: Site) -> GateLine | None:
    """Return how the run stands to the gate that its workspace configures now; None where that cannot be read."""
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.dashboard.gate_line import gate_line
    from roslens.judge.quality.gate import GateFacts, Lines, evaluate
    from roslens.model.errors import RoslensError

    try:
        configured = find_configuration(Path(site.view.header.root), None)
    except RoslensError:
        return None
    severities = site.severity_counts()
    counts = {f"{one.value}s": count for one, count in severities.items()}
    results = tuple(evaluate(configured.gate, GateFacts(counts, Lines(), None, None))) if configured.gate else ()
    return gate_line(severities, configured.fail_on, results)
