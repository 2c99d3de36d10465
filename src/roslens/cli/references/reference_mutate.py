"""``roslens reference mutate``: known faults put into a healthy recording, and which of them references see."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

from roslens.cli.terminal.boundary import CLEAN, FINDINGS, NOT_ANALYSED

if TYPE_CHECKING:
    from collections.abc import Sequence

    from roslens.judge.reference.expectation import Reference
    from roslens.live.adapters.bag.excerpt import Kept
    from roslens.live.mutation.fault import Fault
    from roslens.live.mutation.score import Cell, Score
    from roslens.live.mutation.trial import Trial
    from roslens.live.replay.alarms import Alarm

TEXT = "Inject known faults into a healthy recording, and report which of them the references detect, as a score."
EXAMPLES = """\
  roslens reference mutate robot.yaml --bag drive.mcap                     a table of what is seen and what is not
  roslens reference mutate robot.yaml --bag drive.mcap --time 5min         more stretches of it
  roslens reference mutate robot.yaml --bag drive.mcap --at-least 80 --json    for CI: exit code 1 below 80 %"""

TIME_S = 60.0
_TELL_S = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the references, the recording and how long to try."""
    parser.add_argument("files", nargs="+", metavar="FILE", help="references, later ones taking precedence")
    parser.add_argument("--bag", type=Path, nargs="+", metavar="FILE", required=True, help="a healthy recording")
    parser.add_argument(
        "--topic", action="append", metavar="PATTERN", help="only faults of such topics; may be repeated"
    )
    parser.add_argument(
        "--time", default=f"{TIME_S:g} s", metavar="TIME", help="how long to try at most (default: %(default)s)"
    )
    parser.add_argument(
        "--at-least",
        type=float,
        metavar="SHARE",
        help="exit with 1 if fewer than this percentage of faults is detected (default: 0)",
    )
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument("-q", "--quiet", action="store_true", help="print no progress")
    parser.set_defaults(act=mutate)


def mutate(options: argparse.Namespace) -> int:
    """Print the score and return the exit code: 1 where it is below what is asked for.

    Raises:
        DocumentError: a document is wrong.
        UsageError: there is no recording, or it is too short to put faults into it.
    """
    from roslens.judge.ranges.amount import parse_amount
    from roslens.judge.reading.read_reference import load_reference
    from roslens.live.adapters.bag.excerpt import Kept
    from roslens.live.adapters.bag.open_bag import open_bag
    from roslens.live.replay.replay import wanted_fields, wanted_stamps
    from roslens.live.window.signals import BY_KEY
    from roslens.model.errors import UsageError

    try:
        budget_s = parse_amount(options.time, "s")
    except ValueError as error:
        raise UsageError(f"--time: {error}") from None
    if options.at_least is not None and not 0 <= options.at_least <= 100:
        raise UsageError(f"--at-least {options.at_least:g}", expected="a share from 0 to 100")
    reference = load_reference([Path(file) for file in options.files], BY_KEY)
    bag = open_bag(options.bag)
    fields = wanted_fields(reference, ((topic.name, topic.type) for topic in bag.topics))
    kept = Kept(bag, wanted_stamps(reference, bag.topics), fields)
    result = _tried(options, reference, kept, budget_s)
    if options.json:
        import msgspec

        document = {**msgspec.to_builtins(result), "share": round(100 * result.share, 1)}
        print(msgspec.json.format(msgspec.json.encode(document), indent=2).decode())
    else:
        print(table(result))
    for failure in kept.failures:
        print(f"roslens: {failure}", file=sys.stderr)
    if options.at_least is not None and 100 * result.share < options.at_least:
        return FINDINGS
    return NOT_ANALYSED if kept.failures else CLEAN


def _tried(options: argparse.Namespace, reference: Reference, kept: Kept, budget_s: float) -> Score:
    from roslens.live.mutation.score import score
    from roslens.live.mutation.trial import margins, planned
    from roslens.live.replay.alarms import AlarmLog
    from roslens.live.replay.replay import replay
    from roslens.model.errors import UsageError

    lanes = _lanes(options.topic or (), kept)
    before_s, after_s = margins(reference)
    plan = list(planned(lanes, kept.start, kept.end, before_s, after_s))
    if not plan:
        raise UsageError(
            f"a recording of {kept.end - kept.start:.1f} s",
            expected=f"at least {before_s + after_s + 5:.0f} s, so that there is time before and after a fault",
        )
    began = time.monotonic()
    log = AlarmLog()
    replay(kept.excerpt(kept.start, kept.end), reference, report=lambda step: log.add(step.changes))
    healthy: Sequence[Alarm] = log.alarms()
    trials: list[Trial] = []
    reported = began
    runner = _Runner(reference, kept, (before_s, after_s))
    for fault in plan:
        now = time.monotonic()
        if now - began > budget_s:
            break
        if not options.quiet and now - reported > _TELL_S:
            reported = now
            print(f"roslens: {len(trials)} of {len(plan)} faults tried in {now - began:.0f} s", file=sys.stderr)
        trials.append(runner.run(fault))
    return score(
        trials,
        healthy,
        recording=[str(path) for path in options.bag],
        references=options.files,
        seconds=kept.end - kept.start,
        planned=len(plan),
    )


class _Runner:
    """Tries faults, and knows those that need no trial."""

    def __init__(self, reference: Reference, kept: Kept, margins_s: tuple[float, float]) -> None:
        from roslens.live.mutation.trial import Trials

        self._kept = kept
        self._trials = Trials(reference, kept.excerpt, margins_s)

    def run(self, fault: Fault) -> Trial:
        """Try a fault."""
        from roslens.live.mutation.fault import FaultKind
        from roslens.live.mutation.trial import Trial

        if fault.kind is FaultKind.WRONG_VALUE and not self._kept.checked(fault.topic):
            return Trial(fault, seen=False, why="no constraint is about its fields")
        concerned = [
            (lane.topic, lane.publisher) for lane in self._kept.lanes if fault.concerns(lane.topic, lane.publisher)
        ]
        return self._trials.run(fault, concerned)


def _lanes(patterns: Sequence[str], kept: Kept) -> dict[tuple[str, str], float]:
    """Return the mean period in seconds by topic and publisher."""
    from roslens.judge.patterns.pattern import Pattern
    from roslens.model.errors import UsageError

    try:
        chosen = [Pattern.parse(text) for text in patterns]
    except ValueError as error:
        raise UsageError(f"--topic: {error}") from None
    lanes = {
        (lane.topic, lane.publisher): float(times[-1] - times[0]) / 1e9 / (len(times) - 1)
        for lane, (times, _, _) in kept.lanes.items()
        if len(times) > 1 and (not chosen or any(pattern.matches(lane.topic) for pattern in chosen))
    }
    if not lanes:
        raise UsageError("no topic to put faults into", expected="one with two messages or more")
    return lanes


def table(result: Score) -> str:
    """Return a score as text: a line per topic, a column per kind of fault."""
    kinds = list(result.kinds)
    heads = ["topic", *kinds]
    rows = [[topic, *(_words(cells[kind]) for kind in kinds)] for topic, cells in result.topics.items()]
    rows.append(["all", *(_words(result.kinds[kind]) for kind in kinds)])
    widths = [max(map(len, column)) for column in zip(heads, *rows, strict=True)]
    lines = [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in (heads, *rows)
    ]
    middle = "" if result.total.after_s is None else f", in the middle after {result.total.after_s:.1f} s"
    lines += [
        "",
        f"{result.total.seen} of {result.total.tried} faults are seen ({100 * result.share:.0f} %){middle}",
        f"{result.false_alarms} alarms in {result.seconds:.1f} s without fault ({result.false_per_hour:.1f} per hour)",
        f"{result.beside} faults raised alarms for other entities only",
    ]
    if result.total.tried < result.planned:
        lines.append(f"{result.total.tried} of {result.planned} faults were tried: the time was over (--time)")
    if result.false_alarms:
        lines.append("what the recording raises without a fault is not seen a second time: best take a healthy one")
    if result.unseen:
        lines += ["not seen:", *(f"  {one}" for one in result.unseen)]
    return "\n".join(lines)


def _words(cell: Cell) -> str:
    if not cell.tried:
        return "-"
    after = "" if cell.after_s is None else f" {cell.after_s:.1f} s"
    return f"{cell.seen}/{cell.tried}{after}"
