"""Where the command starts: what the current folder holds is imported no more, and an interrupt ends it at once.

Nothing is imported here before that, not even by ``from __future__``; ``_signal`` is part of the interpreter, where
``signal`` takes a while to import.
"""

import _signal  # type: ignore[import-not-found]  # typeshed has signal alone
import os
import sys


def main() -> int:
    """Run the command line of this process and return its exit code."""
    _signal.signal(_signal.SIGINT, _signal.SIG_DFL)
    leave_current_folder()
    from roslens.children.safe_path import shorten_search_paths

    shorten_search_paths()
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


def leave_current_folder() -> None:
    """Take folders off the search path for modules that it has by entries of ``PYTHONPATH`` which are no whole paths.

    Python puts the current folder there for an empty entry, and a workspace may be that. The folder of roslens stays.
    """
    own = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))  # noqa: PTH100, PTH120 - no import
    named = os.environ.get("PYTHONPATH", "")
    given = named.split(os.pathsep) if named else []
    left = {os.path.abspath(place) for place in given if not os.path.isabs(place)} - {own, *given}  # noqa: PTH100, PTH117 - as above
    sys.path[:] = [place for place in sys.path if os.path.isabs(place) and place not in left]  # noqa: PTH117 - as above
