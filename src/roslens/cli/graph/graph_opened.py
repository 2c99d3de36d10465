"""The workspace of ``roslens graph``, by its options and ``roslens.toml``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.graph.graph_source import GraphSource


def open_source(options: argparse.Namespace, folder: str | None = None) -> GraphSource:
    """Find the packages of the workspace; its configuration and its cache are those of PATH.

    Args:
        options: of the command line.
        folder: where the files of a revision of it stand, instead of PATH.

    Raises:
        UsageError: there is no such folder, or the configuration file is wrong.
    """
    import os

    import msgspec

    from roslens.cli.graph.graph_source import GraphSource
    from roslens.cli.workplace.configuration import find_configuration
    from roslens.cli.workplace.workplace import CACHE, own_folder
    from roslens.source.workspace.conditions import environment_of
    from roslens.source.workspace.find import root_of

    if options.jobs is not None and options.jobs < 0:
        raise UsageError(f"--jobs {options.jobs}", expected="0 (one per processor) or a positive number")
    root = root_of([options.path])
    configuration = find_configuration(root, options.config)
    settings = configuration.source
    seen = {**environment_of(os.environ), **settings.workspace.environment}
    workspace = msgspec.structs.replace(settings.workspace, environment=seen)
    settings = msgspec.structs.replace(settings, workspace=workspace)
    source = GraphSource(
        folder or options.path,
        settings,
        Path(configuration.path).name,
        dict(os.environ),
        cache=None if options.no_cache else own_folder(root) / CACHE,
        jobs=configuration.jobs if options.jobs is None else options.jobs,
        elsewhere=folder is not None,
    )
    for failure in source.failures:
        # What is wrong with manifests is reported by `check`; a workspace without packages has no graph.
        if options.verbose or not source.facts.packages:
            print(f"roslens: {failure.what}; expected {failure.expected}", file=sys.stderr)
    return source
