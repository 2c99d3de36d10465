"""``roslens serve --bag``, ``--history`` and ``--live`` where no source was checked: the live pages alone."""

from __future__ import annotations

import argparse
import sys
import time
from contextlib import ExitStack
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.cli.page.door import Door
    from roslens.cli.page.watch_page import PageSource
    from roslens.dashboard.live.further import Further

_LOOK_S = 0.1


def needs_no_run(options: argparse.Namespace) -> bool:
    """Return whether what is to be shown is a running or recorded system, and no run of a source is kept here.

    Raises:
        UsageError: the workspace does not exist.
    """
    from roslens.cli.workplace.shared_store import shared_address
    from roslens.cli.workplace.workplace import refuse_missing, some_folder

    refuse_missing(options.path)
    of_source = options.no_store or options.changed or options.number is not None or options.against or options.accept
    shows_system = options.live or options.bag or options.history
    return bool(
        shows_system and not of_source and some_folder(options.path) is None and not shared_address(options.path)
    )


def serve_alone(options: argparse.Namespace, page: PageSource | None, door: Door, further: Further | None) -> None:
    """Serve the live pages until Ctrl-C or a request to end, and say how the source joins them.

    Args:
        options: of the command line.
        page: what is shown; None, which only options that show no system give, serves nothing.
        door: who may open it.
        further: pages beside it.

    Raises:
        UsageError: the address cannot be listened on.
    """
    from roslens.cli.terminal.until_stopped import when_stopped
    from roslens.cli.watch.watch_serve import serve

    if not options.quiet:
        print(
            "roslens: no source was checked here, so there are no pages of it: "
            f"`roslens check {options.path}` makes them",
            file=sys.stderr,
        )
    if page is None:
        return
    with ExitStack() as stack:
        ended = when_stopped(stack)
        stack.enter_context(serve(page, (options.host, options.port), door, further))
        while not ended:
            time.sleep(_LOOK_S)
