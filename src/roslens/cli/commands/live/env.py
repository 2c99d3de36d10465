"""``roslens env``: print the environment in which nodes count their own traffic, for a shell to read."""

from __future__ import annotations

import argparse

TEXT = "Print the environment that enables message counting in the nodes started from a shell."
EXAMPLES = """\
  eval "$(roslens env)"            from now on, in this shell
  eval "$(roslens env --undo)"     no longer
  roslens env --shell fish | source"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the shell and the way back."""
    parser.add_argument("--shell", choices=("sh", "fish"), default="sh", help="syntax to print (default: sh)")
    parser.add_argument("--undo", action="store_true", help="print what undoes it")


def run(options: argparse.Namespace) -> int:
    """Print one line per variable."""
    import os
    import sys

    from roslens.live.inside.environment import environment, undone
    from roslens.live.inside.preload import why_no_library

    variables: dict[str, str | None] = {}
    variables.update(undone(os.environ) if options.undo else environment(os.environ))
    if not options.undo and (missing := why_no_library()):
        print(missing, file=sys.stderr)
    for name, value in sorted(variables.items()):
        print(_line(options.shell, name, value))
    return 0


def _line(shell: str, name: str, value: str | None) -> str:
    import shlex

    if shell == "fish":
        if value is None:
            return f"set -e {name};"
        quoted = value.replace("\\", "\\\\").replace("'", "\\'")
        return f"set -gx {name} '{quoted}';"
    return f"unset {name};" if value is None else f"export {name}={shlex.quote(value)};"
