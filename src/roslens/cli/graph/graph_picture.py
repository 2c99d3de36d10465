"""``roslens graph --html`` and ``--format svg``: a picture of configurations, and of what does not fit in them."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource
    from roslens.model.configuration import Configuration


def draw(
    source: GraphSource,
    found: tuple[Configuration, ...],
    options: argparse.Namespace,
    unstarted: tuple[Configuration, ...] = (),
) -> None:
    """Write the picture that is asked for; what no known program starts is listed there.

    Raises:
        UsageError: one SVG cannot hold what was found, or a file cannot be written.
    """
    from roslens.cli.graph.graph_choice import chosen
    from roslens.cli.graph.graph_findings import findings_of
    from roslens.cli.graph.graph_source import arguments_of

    if options.format == "svg" and len(found) != 1:
        raise UsageError(
            "--format svg of packages of both generations" if found else "--format svg without any node",
            expected="one configuration",
            advice="Choose with --launch or --package",
        )
    given = arguments_of(options.arg)
    findings = [findings_of(source, one, options.launch or "", given) for one in found]
    shown = [chosen(one, options.node, implicit=True) for one in found]
    if options.format == "svg":
        from roslens.cli.terminal.streams import write_result
        from roslens.dashboard.computation.to_svg import to_svg

        loose = () if options.node else unstarted
        write_result(to_svg(shown[0], findings[0], everything=options.all, unstarted=loose), options.output)
        return
    from roslens.dashboard.computation.pages import computation_file

    names = _names(found)
    computation_file(
        dict(zip(names, shown, strict=True)),
        Path(options.html),
        dict(zip(names, findings, strict=True)),
        title=Path(options.path).resolve().name,
        unstarted=() if options.node else unstarted,
    )
    print(options.html)


def _names(found: tuple[Configuration, ...]) -> list[str]:
    names = [Path(one.title.partition(" ")[0]).name or one.generation for one in found]
    if len(set(names)) < len(names):
        return [f"{name}-{one.generation}" for name, one in zip(names, found, strict=True)]
    return names
