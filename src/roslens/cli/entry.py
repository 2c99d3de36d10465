"""Where the command starts: while modules are imported, an interrupt ends it at once and without a traceback."""

from __future__ import annotations

import signal


def main() -> int:
    """Run the command line of this process and return its exit code."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    from roslens.cli.main import main as run

    return run()
