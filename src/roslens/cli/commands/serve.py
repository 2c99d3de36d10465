"""``roslens serve``: the pages of the last run in a browser."""

from __future__ import annotations

import argparse
import sys

from roslens.cli.shown_graphs import add_shown_argument
from roslens.cli.streams import add_stream_arguments, progress_for
from roslens.cli.workplace import add_workspace_argument

TEXT = "Serve the pages of the last run on this machine."
EXAMPLES = """\
  roslens serve
  roslens serve ~/robot_ws --port 8081"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the workspace and the address."""
    add_workspace_argument(parser)
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on (default: this machine only)")
    parser.add_argument("--port", type=int, default=8080, help="port (default: 8080; 0 takes a free one)")
    parser.add_argument("--run", type=int, metavar="N", dest="number", help="another run than the last one")
    add_shown_argument(parser)
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Serve until interrupted.

    Raises:
        UsageError: there is no run, or the port is taken.
        StoreError: the store cannot be read.
    """
    from roslens.cli.shown_graphs import site_with_graphs
    from roslens.cli.workplace import open_store
    from roslens.dashboard.server import serve

    with open_store(options.path) as store:
        site = site_with_graphs(store.view(options.number), options, progress_for(options))
        serve(site, host=options.host, port=options.port, ready=_ready)
    return 0


def _ready(url: str) -> None:
    print(f"roslens: {url} (Ctrl-C ends it)", file=sys.stderr, flush=True)
