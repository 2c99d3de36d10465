"""``colcon roslens``: ``roslens check`` as a verb of colcon; only colcon imports this."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from colcon_core.plugin_system import satisfies_version
from colcon_core.verb import VerbExtensionPoint

from roslens.cli.commands import check
from roslens.cli.graph.graph_stage import settle_graph_argument
from roslens.cli.terminal.boundary import guarded


class RoslensVerb(VerbExtensionPoint):  # type: ignore[misc]
    """Measure and judge the packages of the workspace with roslens."""

    def __init__(self) -> None:
        super().__init__()
        satisfies_version(VerbExtensionPoint.EXTENSION_POINT_VERSION, "^1.0")

    def add_arguments(self, *, parser: argparse.ArgumentParser) -> None:
        """Add the options of ``roslens check``."""
        check.add_arguments(parser)
        parser.set_defaults(paths=[])

    def main(self, *, context: Any) -> int:
        """Check the folders given, or those that colcon looks into: ``src`` where there is one."""
        options = context.args
        settle_graph_argument(options)
        options.paths = options.paths or ["src" if Path("src").is_dir() else "."]
        return guarded(lambda: check.run(options), ["check", *options.paths])
