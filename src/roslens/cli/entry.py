"""Where the command starts: while modules are imported, an interrupt ends it at once and without a traceback."""

from __future__ import annotations

import signal
import sys


def main() -> int:
    """Run the command line of this process and return its exit code."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    from roslens.cli.terminal.standard_streams import close_output, open_streams

    open_streams()
    from roslens.cli.main import main as run
    from roslens.cli.terminal.watched_command import watched

    try:
        code = watched(run, sys.argv[1:])
    except SystemExit as end:
        # The parser of the command line ends so, also after help that may not have been read.
        code = end.code if isinstance(end.code, int) else 0 if end.code is None else 1
    return close_output(code)
