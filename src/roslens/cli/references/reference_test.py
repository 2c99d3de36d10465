"""``roslens reference test``: what references would have said and done, held against what is expected."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.terminal.boundary import CLEAN, FINDINGS, NOT_ANALYSED

if TYPE_CHECKING:
    from roslens.live.replay.alarms import Alarm
    from roslens.live.replay.expected_alarms import ExpectedAlarm

TEXT = (
    "Report the alarms that references would have raised on a recording, with --expect whether they are as expected; "
    "and test whether reactions decide as time lines (robot.test.yaml next to robot.yaml) expect."
)
EXAMPLES = """\
  roslens reference test robot.yaml                                        the time lines in robot.test.yaml
  roslens reference test robot.yaml --timeline night.yaml                  other ones
  roslens reference test robot.yaml --bag drive.bag                        what it would have raised, and when
  roslens reference test robot.yaml --bag drive.bag --expect alarms.yaml   exit code 1 where it is not that"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the references, the recording and what is expected of it."""
    parser.add_argument("files", nargs="+", metavar="FILE", help="references, later ones taking precedence")
    parser.add_argument("--bag", type=Path, nargs="+", metavar="FILE", help="a recording")
    parser.add_argument(
        "--timeline",
        type=Path,
        nargs="+",
        metavar="FILE",
        help="time lines (default: FILE.test.yaml next to FILE.yaml)",
    )
    parser.add_argument("--expect", type=Path, metavar="FILE", help="the alarms that have to be raised (YAML)")
    parser.set_defaults(act=test)


def test(options: argparse.Namespace) -> int:
    """Write what came of it and return the exit code: 1 where that is not as expected.

    Raises:
        DocumentError: a document is wrong.
        UsageError: there is nothing to test with.
    """
    from roslens.cli.references.reference_time_lines import ENDING, beside, run_time_lines
    from roslens.model.errors import UsageError

    if options.expect and not options.bag:
        raise UsageError("--expect without --bag", expected="the recording that it is about")
    lines = options.timeline or ([] if options.bag else beside(options.files))
    if not lines and not options.bag:
        stem = Path(options.files[0]).with_suffix("")
        raise UsageError(
            "neither a recording nor a time line",
            expected=f"--bag, --timeline, or a file {str(stem.with_suffix(ENDING))!r}",
        )
    passed = run_time_lines(options.files, lines) if lines else True
    code = _test_bag(options) if options.bag else CLEAN
    return code if passed else FINDINGS


def _test_bag(options: argparse.Namespace) -> int:
    from roslens.cli.watch.about_nothing import RECORDED, about_nothing
    from roslens.judge.reading.read_reference import load_reference
    from roslens.live.adapters.bag.open_bag import open_bag
    from roslens.live.replay.alarms import AlarmLog
    from roslens.live.replay.expected_alarms import ExpectedAlarms, compare, read_expected
    from roslens.live.replay.replay import replay
    from roslens.live.window.signals import BY_KEY

    expected = read_expected(options.expect) if options.expect else ExpectedAlarms(())
    reference = load_reference([Path(file) for file in options.files], BY_KEY)
    bag = open_bag(options.bag)
    log = AlarmLog()
    session = replay(bag, reference, report=lambda step: log.add(step.changes))
    alarms = log.alarms()
    for alarm in alarms:
        print(line_of(alarm, bag.start))
    outcome = compare(alarms, expected, bag.start)
    for note in about_nothing(session, reference, bag.end, RECORDED):
        print(f"roslens: {note.text}", file=sys.stderr)
    for failure in bag.failures:
        print(f"roslens: {failure}", file=sys.stderr)
    for missing in outcome.missing:
        print(f"roslens: {options.expect}:{missing.line}: not raised: {_words(missing)}", file=sys.stderr)
    if options.expect:
        for surplus in outcome.surplus:
            print(f"roslens: not expected: {line_of(surplus, bag.start)}", file=sys.stderr)
    count = "no alarm" if not alarms else "1 alarm" if len(alarms) == 1 else f"{len(alarms)} alarms"
    print(f"{count} in {bag.end - bag.start:.1f} s" + (", as expected" if options.expect and outcome.passed else ""))
    if not outcome.passed:
        return FINDINGS
    return NOT_ANALYSED if bag.failures else CLEAN


def line_of(alarm: Alarm, start: float) -> str:
    """Return when an alarm began, counted from ``start``, how long it lasted, and its text."""
    from roslens.live.publish.diagnostics import verdict_message

    length = "to the end" if alarm.until == float("inf") else f"for {max(alarm.until - alarm.since, 0):.1f} s"
    return f"{alarm.since - start:9.2f} s  {length:>11}  {alarm.worst.entity}  {verdict_message(alarm.worst)}"


def _words(expected: ExpectedAlarm) -> str:
    parts = [expected.entity, expected.quantity, expected.state.value if expected.state else ""]
    return f"{' '.join(part for part in parts if part)} at {expected.at:g} s (within {expected.within:g} s)"
