"""``roslens react``: carry out the reactions of a reference to faults, as far as allowed."""

from __future__ import annotations

import argparse
from pathlib import Path

from roslens.cli.page.door import add_door_arguments
from roslens.cli.react import react_simulate
from roslens.cli.react.react_options import add_hand_arguments, add_limit_arguments
from roslens.cli.terminal.streams import add_stream_arguments
from roslens.cli.watch.observers import add_observer_arguments
from roslens.cli.watch.param_reference import add_reference_argument, reference_argument
from roslens.model.errors import UsageError

TEXT = "Watch a running ROS system, and act on faults as its reference specifies, within the permissions given."
EXAMPLES = """\
  roslens react rover.yaml                                  print what would be done (--mode dry-run), and do nothing
  roslens react rover.yaml --mode ask                       ask in the terminal before anything is done to the robot
  roslens react rover.yaml --mode act --allow allow.yaml
                                                            do it; on processes of this host what allow.yaml permits
  roslens react rover.yaml --mode ask --serve 8080          ask on a page; who opens its address may answer
  roslens react --hold "changing the gripper"               nothing is done any more, at once
  roslens react --release                                   go on
  roslens react rover.yaml --simulate --bag drive.mcap      what would have been done along a recording
  roslens journal --follow                                  what was decided and done, and why"""

MODES = ("dry-run", "ask", "act")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what to watch, what may be done, and how to stop it."""
    parser.add_argument("files", nargs="*", metavar="FILE", help="references with reactions, as --reference takes them")
    add_reference_argument(parser)
    parser.add_argument(
        "--mode", choices=MODES, default="dry-run",
        help="dry-run: only report; ask: confirm in the terminal; act: carry out (default: dry-run)",
    )  # fmt: skip
    add_hand_arguments(parser)
    parser.add_argument("--journal", type=Path, metavar="FILE", help="default: in the state folder of this user")
    parser.add_argument(
        "--serve", metavar="[HOST:]PORT",
        help="show it in a browser, with the journal and the questions of --mode ask (a port alone: on this machine)",
    )  # fmt: skip
    add_door_arguments(parser)
    parser.add_argument("--publish-journal", metavar="TOPIC", help="publish each entry in ROS, as JSON in a String")
    held = parser.add_mutually_exclusive_group()
    held.add_argument("--hold", nargs="?", const="", metavar="WHY", help="stop all actions from this host at once")
    held.add_argument("--release", action="store_true", help="resume, including nodes that were left alone")
    add_limit_arguments(parser)
    react_simulate.add_arguments(parser)
    add_observer_arguments(parser)
    parser.add_argument(
        "--for",
        dest="length",
        metavar="TIME",
        help="stop after this time (`60s`, `5 min`); with --hold: release after it",
    )
    parser.add_argument("--json", action="store_true", help="print JSON: a line for each entry of the journal")
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """React until interrupted, or hold, release or simulate.

    Raises:
        UsageError: the options contradict each other or name something that is not there.
        DocumentError: a reference or the allow-list is wrong, or calls for what cannot be done.
    """
    if options.hold is not None or options.release:
        return _held(options)
    options.reference = [*options.reference, *map(reference_argument, options.files)]
    if not options.reference:
        raise UsageError("nothing to react to", expected="a FILE with `reactions:` in it")
    if options.simulate:
        files = [str(one) for one in options.reference]
        return react_simulate.simulate(
            files, bag=options.bag, timeline=options.timeline, as_json=options.json, quiet=options.quiet
        )
    if options.bag or options.timeline:
        option = "--bag" if options.bag else "--timeline"
        raise UsageError(
            f"{option} without --simulate", expected="both", advice="Only a running system can be acted on"
        )
    from roslens.cli.react.react_live import react_live

    return react_live(options)


def _held(options: argparse.Namespace) -> int:
    import getpass
    import os
    import time

    from roslens.cli.react.hold_file import hold, hold_path, release
    from roslens.cli.watch.watch_live import length_of

    path = hold_path(os.environ)
    if options.release:
        print(f"{path}: {'released' if release(os.environ) else 'nothing was held'}")
        return 0
    until = time.time() + length_of(options.length, "--for") if options.length is not None else None
    hold(os.environ, getpass.getuser(), options.hold, until)
    print(f"{path}: everything is held {'until ' + time.ctime(until) if until else 'until `roslens react --release`'}")
    return 0
