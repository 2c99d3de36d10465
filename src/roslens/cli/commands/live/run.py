"""``roslens run``: start nodes so that they count their own traffic."""

from __future__ import annotations

import argparse

TEXT = "Run a command so that the nodes it starts count their messages, without a change to their code."
EXAMPLES = """\
  roslens run -- ros2 launch demo robot.launch.py
  roslens run -- python3 talker.py"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the command."""
    parser.add_argument("command", nargs=argparse.REMAINDER, metavar="-- COMMAND…", help="what to run")


def run(options: argparse.Namespace) -> int:
    """Become the command, whose exit code is then that of roslens.

    Raises:
        UsageError: there is no command, or it cannot be started.
    """
    import os
    import sys

    from roslens.live.inside.environment import environment
    from roslens.live.inside.preload import why_no_library
    from roslens.model.errors import UsageError

    command = options.command[1:] if options.command[:1] == ["--"] else options.command
    if not command:
        raise UsageError("no command", expected="one after --", advice="roslens run -- python3 talker.py")
    if missing := why_no_library():
        print(missing, file=sys.stderr)
    sys.stdout.flush()
    sys.stderr.flush()
    try:
        os.execvpe(command[0], command, {**os.environ, **environment(os.environ)})  # noqa: S606 - what the user asked for
    except OSError as error:
        raise UsageError(
            f"{command[0]!r} cannot be started: {error.strerror}",
            expected="a program on the PATH, or its file",
            advice="Try the command without roslens first",
        ) from None
