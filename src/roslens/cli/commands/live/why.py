"""``roslens why``: one ordered answer to why a topic, node, service, action or transform does not do what it should."""

from __future__ import annotations

import argparse
import contextlib
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.completion_words import ARGUMENTS, LAUNCHES
from roslens.cli.terminal.streams import add_stream_arguments
from roslens.cli.watch.observers import add_observer_arguments, given
from roslens.cli.workplace.reading_options import add_reading_arguments
from roslens.model.errors import UsageError

if TYPE_CHECKING:
    from roslens.cli.why.observed_evidence import Looking
    from roslens.compare.why.declared import Declared
    from roslens.compare.why.recorded import Recorded
    from roslens.model.configuration import Configuration

TEXT = "Say why a topic, node, service, action or transform does not work: the first cause, and each step to it."
EXAMPLES = """\
  roslens why /scan                          from the source of the packages below this folder
  roslens why /scan --launch rover_bringup/rover.launch.py --arg navigation:=false
  roslens why /scan --bag drive.mcap         joined with what a recording has
  roslens why /planner --bag drive.bag --no-source
  roslens why 'map->base_link' --bag drive.mcap     can it be looked up, and if not, why; or --live; frame:laser: one
  roslens why /scan --live                   joined with what runs here; --ros1, --ros2 as of watch
  roslens why service:/set_mission --json    kinds: topic, service, action, node, frame

exit codes: as everywhere; 1 where a cause was found"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is asked, and what is looked at."""
    parser.add_argument(
        "entity",
        metavar="ENTITY",
        help="a name such as /scan, with its kind, node:/planner, or a transform: 'map->base_link'",
    )
    parser.add_argument("path", nargs="?", default=".", metavar="PATH", help="the workspace (default: this folder)")
    parser.add_argument("--bag", type=Path, nargs="+", metavar="FILE", help="a recording (ROS 1 bag, MCAP, SQLite)")
    parser.add_argument("--live", action="store_true", help="look at what runs here (so do --ros1 and --ros2)")
    parser.add_argument(
        "--for",
        dest="length",
        metavar="TIME",
        help="look at what runs for this time (default: until nothing new comes)",
    )
    add_observer_arguments(parser.add_argument_group("of what runs"))
    parser.add_argument("--no-source", action="store_true", help="look at no source")
    launch = parser.add_argument(
        "--launch", metavar="FILE", help="what is started: PACKAGE/FILE, a path, or a name of [graph.configurations] "
        "(default: of those of the workspace one that has the entity)",
    )  # fmt: skip
    argument = parser.add_argument(
        "--arg", action="append", default=[], metavar="NAME:=VALUE", help="argument of the launch file; may be repeated"
    )
    # Scripts of shells are made from what actions hold under this name.
    vars(launch)["complete"], vars(argument)["complete"] = LAUNCHES, ARGUMENTS
    parser.add_argument("--json", action="store_true", help="write the answer as JSON")
    parser.add_argument("-o", "--output", metavar="FILE", help="write the answer to this file instead")
    add_reading_arguments(parser)
    add_stream_arguments(parser)


def run(options: argparse.Namespace) -> int:
    """Look, answer, and return 1 where a cause was found.

    Raises:
        UsageError: nothing is called so, or there is nothing to look at.
    """
    import sys

    from roslens.cli.terminal.boundary import CLEAN, FINDINGS
    from roslens.cli.terminal.streams import width_of, write_result
    from roslens.compare.why.answered import answer, known_to
    from roslens.compare.why.question import question_of
    from roslens.report.why.answer_text import to_answer_json, to_answer_text

    if options.no_source and options.launch:
        raise UsageError("--launch with --no-source", expected="one of them")
    with _looking(options) as looking:
        # Observers take a second to start, in which the rest is read.
        recorded = _recorded(options)
        declared = _declared(options, alone=recorded is None and looking is None)
        observed = looking.observed() if looking is not None else None
    question = question_of(options.entity, known_to(declared, recorded, observed))
    found = answer(question, declared, recorded, observed)
    text = to_answer_json(found) if options.json else to_answer_text(found, width_of(sys.stdout))
    write_result(text, options.output)
    return CLEAN if found.cause is None else FINDINGS


def _recorded(options: argparse.Namespace) -> Recorded | None:
    if not options.bag:
        return None
    from roslens.cli.why.recorded_evidence import recorded_evidence
    from roslens.compare.why.question import frames_of

    return recorded_evidence(options, frames_of(options.entity))


def _looking(options: argparse.Namespace) -> contextlib.AbstractContextManager[Looking | None]:
    if not (options.live or options.ros1 or options.ros2):
        if given_of_observers := given(options) or ("--for" if options.length else ""):
            raise UsageError(f"{given_of_observers} without --live", expected="both")
        return contextlib.nullcontext()
    from roslens.cli.why.observed_evidence import Looking

    return Looking(options)


def _declared(options: argparse.Namespace, *, alone: bool) -> Declared | None:
    """Return what source says; None where it is not wanted, or there is none beside a recording.

    Raises:
        UsageError: source is all that could be looked at, and there is none.
    """
    from roslens.cli.why.declared_evidence import declared_evidence
    from roslens.compare.why.question import frames_of

    if frames_of(options.entity):
        if alone:
            raise UsageError(
                f'"{options.entity}" without --bag or --live', expected="a recording with /tf, or ROS 2 that runs",
                advice="Frames and transforms are read from what was said, not from source",
            )  # fmt: skip
        return None
    if options.no_source:
        if alone:
            raise UsageError("--no-source without --bag or --live", expected="something to look at")
        return None
    wanted = options.entity.rpartition(":")[2]
    name = wanted if wanted.startswith("/") else f"/{wanted}"

    def has(configuration: Configuration) -> bool:
        return any(
            name == node.name or any(one.endpoint.name == name for one in node.endpoints)
            for node in configuration.nodes
        )

    found = declared_evidence(options, has)
    if found is None and alone:
        raise UsageError(
            f'"{options.path}" has no node', expected="a workspace with packages that make nodes",
            advice="Name the workspace, or give a recording with --bag",
        )  # fmt: skip
    return found
