"""``roslens top``: the robot that runs, in a terminal, over SSH too."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from roslens.cli.terminal.streams import add_stream_arguments
from roslens.cli.watch.observers import add_observer_arguments, given
from roslens.cli.watch.param_reference import add_reference_argument
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.top.feed import Feed
    from roslens.report.writing.terminal import Terminal

TEXT = "Show a running robot in the terminal: faults by first cause, the tree, plots of the selected entity."
EXAMPLES = """\
  roslens top robot:8080                    what `roslens watch --serve` or `roslens serve --live` there sees
  roslens top --reference rover.yaml        what runs here, observed by itself
  ssh robot -t roslens top --ros2

keys: enter detail, n next alert, / filter, w only what is wrong, space fold, p pause, ? all keys, q end"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add whom to ask, or what to observe."""
    parser.add_argument(
        "address",
        nargs="?",
        metavar="HOST:PORT",
        help="a monitor that serves its page (default: observe what runs here)",
    )
    add_reference_argument(parser)
    add_observer_arguments(parser)
    add_stream_arguments(parser)
    parser.set_defaults(bag=None)


def run(options: argparse.Namespace) -> int:
    """Show it until it is ended.

    Raises:
        UsageError: there is no terminal, no answer, or Textual is not installed.
        DocumentError: a reference is wrong.
    """
    if options.address and (option := "--reference" if options.reference else given(options)):
        raise UsageError(f"{option} with HOST:PORT", expected="one of them", advice="The monitor there observes")
    if not (sys.stdout.isatty() and sys.stdin.isatty()):
        raise UsageError(
            "`roslens top` writes to no terminal", expected="a terminal, such as that of `ssh -t`",
            advice="`roslens watch --format json` writes lines for programs",
        )  # fmt: skip
    _require_textual()
    if options.address:
        from roslens.cli.top.feed import AddressFeed
        from roslens.cli.watch.monitor_address import fetched

        feed = AddressFeed(options.address, fetched)
        feed.snapshot()
        return _shown(feed, options)
    from roslens.cli.top.feed import PageFeed
    from roslens.cli.watch.live_beside import live_beside

    with live_beside(options) as page:
        import platform

        return _shown(PageFeed(platform.node(), page.newest, page.detail), options)


def _require_textual() -> None:
    from importlib.util import find_spec

    if find_spec("textual") is None:
        raise UsageError(
            "Textual is not installed, which `roslens top` needs", expected="the extra `top`",
            advice="pip install 'roslens[top]'; `roslens watch` shows a table without it",
        )  # fmt: skip


def _shown(feed: Feed, options: argparse.Namespace) -> int:
    import os

    from roslens.cli.terminal.boundary import CLEAN
    from roslens.cli.terminal.streams import wants_color
    from roslens.cli.top.board import Board
    from roslens.report.writing.terminal import Terminal

    color = wants_color(options, sys.stdout)
    if not color:
        # What Textual goes by.
        os.environ.setdefault("NO_COLOR", "1")
    unicode = (sys.stdout.encoding or "").lower().startswith("utf")

    def terminal(width: int) -> Terminal:
        return Terminal(width, color, unicode)

    Board(feed, terminal).run()
    return CLEAN
