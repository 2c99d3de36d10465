"""What ``roslens check`` finds in the computation graphs of configurations, as part of a run."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.cli.workplace.configuration import Configuration
    from roslens.source.pipeline import Beyond, Sight
    from roslens.source.progress import Progress
    from roslens.source.settings import SourceSettings


def add_graph_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--graph`` and ``--no-graph``."""
    parser.add_argument(
        "--graph",
        action=argparse.BooleanOptionalAction,
        default=None,
        help="look for what does not fit together in computation graphs: of the configurations in roslens.toml, or of "
        "every launch file that no other includes (default: where there are such configurations)",
    )


def graph_look(
    options: argparse.Namespace,
    configuration: Configuration,
    settings: SourceSettings,
    root: Path,
    cache: Path | None,
    progress: Progress,
) -> Beyond | None:
    """Return the check of configurations; None if it is not requested.

    Args:
        options: of the command line.
        configuration: of the user.
        settings: as the run has them.
        root: of the workspace.
        cache: the file in which is kept what was learned of files; None keeps nothing.
        progress: who watches.
    """
    wanted = bool(settings.graph.configurations) if options.graph is None else options.graph
    if not wanted or "graph" in settings.disable:
        return None
    from roslens.source.pipeline import Beyond
    from roslens.source.rules.graph.findings import RULES

    jobs = configuration.jobs if options.jobs is None else options.jobs
    hinted_in = Path(configuration.path).name

    def look() -> Sight:
        from roslens.cli.graph.graph_configurations import assembled, named_configurations
        from roslens.cli.graph.graph_source import GraphSource
        from roslens.plugins.outcome import Outcome
        from roslens.source.pipeline import Sight

        # Conditions of manifests see what the settings of the run hold of the environment.
        with GraphSource(str(root), settings, hinted_in, {}, cache=cache, jobs=jobs, progress=progress) as source:
            found = assembled(source, named_configurations(source), progress)
        return Sight(Outcome(findings=found.all_findings(), failures=found.failures), found.judged())

    return Beyond("graph", tuple(rule for rule, _ in RULES), look)
