"""Parse and dispatch; nothing else happens here."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from roslens import __version__
from roslens.cli.boundary import guarded
from roslens.cli.commands import (
    agent,
    check,
    clean,
    completion,
    doctor,
    env,
    explain,
    graph,
    init,
    plugins,
    reference,
    report,
    run,
    serve,
    watch,
)

COMMANDS = {
    "check": check,
    "report": report,
    "serve": serve,
    "graph": graph,
    "explain": explain,
    "plugins": plugins,
    "init": init,
    "reference": reference,
    "watch": watch,
    "agent": agent,
    "doctor": doctor,
    "completion": completion,
    "clean": clean,
    "run": run,
    "env": env,
}
"""Verb to module, in the order of ``--help``."""

EPILOG = """\
examples:
  roslens check                    analyse the packages below this folder
  roslens check ~/robot_ws/src     analyse a workspace
  roslens report -o report         write the pages of the last run as a folder
  roslens serve                    look at the last run in a browser
  roslens explain ros.cyclomatic_complexity.max

exit codes: 0 clean, 1 findings at or above --fail-on, 2 usage or bad input,
3 something could not be analysed, 70 a bug, 130 interrupted"""


def parser() -> argparse.ArgumentParser:
    """Return the parser of the whole command line; shell completion is generated from it too."""
    top = argparse.ArgumentParser(
        prog="roslens",
        description="How good is the source of your robot? Measures and judges ROS 1 and ROS 2 packages, "
        "without building or running them.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="version", version=f"roslens {__version__}")
    verbs = top.add_subparsers(title="commands", dest="verb", metavar="COMMAND", required=True)
    for verb, module in COMMANDS.items():
        one = verbs.add_parser(
            verb,
            help=module.TEXT,
            description=module.TEXT,
            epilog=f"examples:\n{module.EXAMPLES}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        module.add_arguments(one)
        one.set_defaults(run=module.run)
    return top


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    options = parser().parse_args(given)
    return guarded(lambda: int(options.run(options)), given)


if __name__ == "__main__":
    sys.exit(main())
