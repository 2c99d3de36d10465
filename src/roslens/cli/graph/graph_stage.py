"""What ``roslens check`` finds in the computation graphs of configurations, as part of a run."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.cli.graph.kept_look import KeptLook
    from roslens.cli.workplace.configuration import Configuration
    from roslens.source.pipeline import Beyond, Sight
    from roslens.source.progress import Progress
    from roslens.source.run_inputs import Seen
    from roslens.source.settings import SourceSettings

ALL = "all"
"""Value of ``--graph`` that looks at every launch file."""
HERE = ["."]
"""The folders that are looked into where none is given; the list itself tells that none was."""
_CHOSEN = "chosen"


def add_graph_argument(parser: argparse.ArgumentParser) -> None:
    """Add ``--graph`` and ``--no-graph``."""
    parser.add_argument(
        "--graph",
        nargs="?",
        const=_CHOSEN,
        metavar=ALL,
        help="check computation graphs, which is the default: of the configurations in roslens.toml, or of the launch "
        "files that together start most nodes; `--graph all`: of every launch file that no other includes",
    )
    parser.add_argument(
        "--no-graph", dest="graph", action="store_const", const=False, help="leave computation graphs out"
    )


def settle_graph_argument(options: argparse.Namespace) -> None:
    """Take a word behind ``--graph`` that is not ``all`` as the path it is: ``roslens check --graph src``."""
    word = options.graph
    if not word or word in (ALL, _CHOSEN):
        return
    options.graph = _CHOSEN
    options.paths = [word] if options.paths is HERE else [*options.paths, word]


def graph_look(
    options: argparse.Namespace,
    configuration: Configuration,
    settings: SourceSettings,
    root: Path,
    cache: Path | None,
    progress: Progress,
    *,
    changed: bool = False,
) -> Beyond | None:
    """Return the check of configurations; None if it is left out.

    Args:
        options: of the command line.
        configuration: of the user.
        settings: as the run has them.
        root: of the workspace.
        cache: the file in which is kept what was learned of files; None keeps nothing.
        progress: who watches.
        changed: whether only changed files count: findings are all that is taken of the graphs then.
    """
    if options.graph is False or "graph" in settings.disable:
        return None
    from roslens.source.pipeline import Beyond
    from roslens.source.rules.graph.findings import RULES

    jobs = configuration.jobs if options.jobs is None else options.jobs
    hinted_in = Path(configuration.path).name
    every = options.graph == ALL

    def look(seen: Seen | None) -> Sight:
        from roslens.cli.graph.graph_source import GraphSource
        from roslens.cli.graph.kept_look import KeptLook

        kept = None
        if seen is not None and cache is not None and not changed:
            kept = KeptLook(cache, seen, settings, str(root), hinted_in, every=every)
            if (earlier := kept.known()) is not None:
                return earlier
        # Conditions of manifests see what the settings of the run hold of the environment.
        with GraphSource(
            str(root), settings, hinted_in, {}, cache=cache, jobs=jobs, progress=progress, seen=seen
        ) as source:
            if changed:
                return _among_changes(source, progress, every=every)
            return _whole(source, kept, progress, every=every)

    return Beyond(f"graph {ALL}" if every else "graph", tuple(rule for rule, _ in RULES), look)


def _among_changes(source: GraphSource, progress: Progress, *, every: bool) -> Sight:
    """Return the findings of a look: what cannot be read elsewhere is left out."""
    from roslens.cli.graph.graph_configurations import assembled, chosen_configurations
    from roslens.plugins.outcome import Outcome
    from roslens.source.run_inputs import Sight

    found = assembled(source, chosen_configurations(source, every=every).named, progress)
    broken = tuple(one for one in found.failures if one.location is not None or one.detail)
    return Sight(Outcome(findings=found.all_findings(), failures=broken))


def _whole(source: GraphSource, kept: KeptLook | None, progress: Progress, *, every: bool) -> Sight:
    """Return all of a look, and keep it for the next run."""
    import msgspec

    from roslens.cli.graph.graph_configurations import assembled, chosen_configurations
    from roslens.model.graphs.completeness import completeness_of, incomplete
    from roslens.plugins.outcome import Outcome
    from roslens.source.run_inputs import Sight
    from roslens.store.configurations import packed_configuration

    chosen = chosen_configurations(source, every=every)
    parts = None if kept is None else kept.parts(source)
    found = assembled(source, chosen.named, progress, parts)
    known = {name: completeness_of(one) for name, one in found.configurations.items()}
    unknown = incomplete(known)
    failures = (*found.failures, *((unknown,) if unknown is not None else ()))
    scope = msgspec.structs.replace(chosen.scope(), completeness=known)
    graphs = tuple(map(packed_configuration, found.judged()))
    sight = Sight(Outcome(findings=found.all_findings(), failures=failures), graphs, scope)
    if kept is not None and not found.failures:
        kept.keep(source, sight, parts)
    return sight
