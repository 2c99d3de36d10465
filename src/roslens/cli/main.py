"""Parse and dispatch; nothing else happens here."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from roslens import __version__
from roslens.cli.commands import (
    accept,
    check,
    clean,
    compare,
    completion,
    doctor,
    evidence,
    explain,
    fetch,
    graph,
    history,
    init,
    interfaces,
    lsp,
    percentile,
    plugins,
    port,
    reference,
    report,
    roles,
    serve,
    study,
    trend,
    trust,
)
from roslens.cli.commands.live import agent, env, journal, react, run, top, watch, why
from roslens.cli.terminal.boundary import guarded
from roslens.cli.terminal.command_parser import CommandParser, refuse, take_late_words

COMMANDS = {
    "check": check,
    "fetch": fetch,
    "report": report,
    "serve": serve,
    "lsp": lsp,
    "graph": graph,
    "interfaces": interfaces,
    "port": port,
    "explain": explain,
    "why": why,
    "study": study,
    "roles": roles,
    "percentile": percentile,
    "evidence": evidence,
    "accept": accept,
    "plugins": plugins,
    "trust": trust,
    "init": init,
    "reference": reference,
    "watch": watch,
    "top": top,
    "history": history,
    "react": react,
    "trend": trend,
    "compare": compare,
    "journal": journal,
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
3 something could not be analysed, 70 a bug, 74 the output could not be written,
130 interrupted, 141 output closed by its reader"""


def parser(only: str | None = None) -> CommandParser:
    """Return the parser of the whole command line; shell completion is generated from it too.

    Args:
        only: the command whose options are wanted. The options of all others are then left out, which is most of what
            it takes to make the parser. None for all.
    """
    top = CommandParser(
        prog="roslens",
        description="How good is the source of your robot, and does it behave when it runs? Measures and judges ROS 1 "
        "and ROS 2 packages without building or running them, and watches systems that run.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("--version", action="version", version=f"roslens {__version__}")
    verbs = top.add_subparsers(title="commands", dest="verb", metavar="COMMAND")
    for verb, module in COMMANDS.items():
        one = verbs.add_parser(
            verb,
            help=module.TEXT,
            description=module.TEXT,
            epilog=f"examples:\n{module.EXAMPLES}",
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        if only in {None, verb}:
            module.add_arguments(one)
        one.set_defaults(run=module.run, top_parser=top)
    return top


def _verb(given: Sequence[str]) -> str | None:
    """Return the command that is certainly meant; None where it may be any, or where it wants the options of all."""
    return given[0] if given and given[0] in COMMANDS and given[0] != "completion" else None


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    top = parser(_verb(given))
    options, unknown = top.parse_known_args(given)
    if unknown := take_late_words(unknown, top, options):
        refuse(unknown, top, options)
    if options.verb is None:
        top.error("the following arguments are required: COMMAND")
    return guarded(lambda: int(options.run(options)), given)


if __name__ == "__main__":
    sys.exit(main())
