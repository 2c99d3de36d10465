"""How a run stands to its gate and to the run before, for the pages that show it."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.dashboard.gate_line import GateLine
    from roslens.dashboard.since_run import SinceRun
    from roslens.dashboard.site import Site
    from roslens.store.read import RunView


@contextmanager
def run_before(options: argparse.Namespace, view: RunView) -> Iterator[SinceRun | None]:
    """Yield the run against the newest one that was kept before it; None where there is none."""
    from roslens.cli.workplace import open_store
    from roslens.dashboard.since_run import SinceRun

    if options.no_store:
        yield None
        return
    with open_store(options.path) as store:
        earlier = max((one.id for one in store.runs() if one.id < view.id), default=None)
        if earlier is None:
            yield None
            return
        before = store.view(earlier)
        yield SinceRun(f"run {earlier}", lambda: tuple(before.findings()), lambda: tuple(view.findings()))


def gate_of(site: Site) -> GateLine | None:
    """Return how the run stands to the gate that its workspace configures now; None where that cannot be read."""
    from roslens.cli.configuration import find_configuration
    from roslens.dashboard.gate_line import gate_line
    from roslens.judge.gate import GateFacts, Lines, evaluate
    from roslens.model.errors import RoslensError

    try:
        configured = find_configuration(Path(site.view.header.root), None)
    except RoslensError:
        return None
    severities = site.severity_counts()
    counts = {f"{one.value}s": count for one, count in severities.items()}
    results = tuple(evaluate(configured.gate, GateFacts(counts, Lines(), None, None))) if configured.gate else ()
    return gate_line(severities, configured.fail_on, results)
