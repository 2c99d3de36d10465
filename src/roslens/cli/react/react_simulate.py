"""``roslens react --simulate``: what would have been done along a recording or a time line, when and why."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roslens.cli.terminal.boundary import CLEAN, FINDINGS, NOT_ANALYSED

if TYPE_CHECKING:
    from roslens.judge.reference.expectation import Reference
    from roslens.live.join.session import Step
    from roslens.live.react.simulation import Simulation
    from roslens.model.acting.reaction import Because, Decision

EXAMPLES = """\
  roslens react --simulate robot.yaml --bag drive.mcap                what would have been done, when and why
  roslens react --simulate robot.yaml --timeline robot.test.yaml      the same of what a time line makes up
  roslens react --simulate robot.yaml --bag drive.mcap --json         the same for programs"""

VERSION = 1
TELL_S = 2.0
"""How often it is said how far a recording was replayed."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what is simulated."""
    parser.add_argument("--simulate", action="store_true", help="do nothing; report what would have been done, and why")
    parser.add_argument("--bag", type=Path, nargs="+", metavar="FILE", help="along a recording")
    parser.add_argument("--timeline", type=Path, metavar="FILE", help="along a time line (YAML)")


def simulate(
    files: Sequence[str], *, bag: Sequence[Path] | None, timeline: Path | None, as_json: bool, quiet: bool = True
) -> int:
    """Print what would have been done; return 1 where that is anything. Unless ``quiet`` it says how far it is.

    Raises:
        DocumentError: a document is wrong.
        UsageError: there is nothing to simulate along, or no reaction.
    """
    from roslens.judge.reading.read_reference import load_reference
    from roslens.live.window.signals import BY_KEY
    from roslens.model.errors import UsageError

    if bool(bag) is bool(timeline):
        raise UsageError(
            "--simulate with both --bag and --timeline" if bag else "--simulate without --bag and without --timeline",
            expected="one of them: the input of the simulation",
        )
    reference = load_reference([Path(file) for file in files], BY_KEY)
    if not reference.reactions:
        raise UsageError(f"no reaction in {', '.join(files)}", expected="a document with `reactions`")
    from roslens.cli.react.reference_reactions import types_not_checked

    for text in types_not_checked(reference.reactions):
        print(f"roslens: {text}", file=sys.stderr)
    runs = [_along_bag(reference, bag, quiet)] if bag else _along_time_lines(reference, timeline or Path())
    if as_json:
        _print_json(runs)
    else:
        for name, start, end, simulation, _ in runs:
            _print(name, start, end, simulation)
    if any(failed for *_, failed in runs):
        return NOT_ANALYSED
    return FINDINGS if any(simulation.decisions for _, _, _, simulation, _ in runs) else CLEAN


_Run = tuple[str, float, float, "Simulation", bool]
"""Name, start, end, what was decided, and whether something could not be read."""


def _along_bag(reference: Reference, files: Sequence[Path], quiet: bool) -> _Run:
    from roslens.live.adapters.bag.open_bag import open_bag
    from roslens.live.react.simulation import Simulation
    from roslens.live.replay.replay import replay

    bag = open_bag(list(files))
    simulation = Simulation(reference.reactions, start=bag.start)

    length = bag.end - bag.start
    due = time.monotonic() + TELL_S

    def take(step: Step) -> None:
        nonlocal due
        simulation.take(step)
        if not quiet and time.monotonic() >= due:
            due = time.monotonic() + TELL_S
            done, actions = step.time - bag.start, len(simulation.decisions)
            text = f"{done:.0f} of {length:.0f} s replayed, {actions} action{'' if actions == 1 else 's'} so far"
            print(f"roslens: {text}", file=sys.stderr, flush=True)

    replay(bag, reference, report=take)
    for failure in bag.failures:
        print(f"roslens: {failure}", file=sys.stderr)
    return ", ".join(map(str, files)), bag.start, bag.end, simulation, bool(bag.failures)


def _along_time_lines(reference: Reference, path: Path) -> list[_Run]:
    from roslens.judge.reading.read_time_line import read_time_lines
    from roslens.live.react.simulation import simulate as along

    return [(line.name, 0.0, line.until_s, along(reference.reactions, line), False) for line in read_time_lines(path)]


def _print(name: str, start: float, end: float, simulation: Simulation) -> None:
    rows: list[tuple[float, list[str]]] = [(one.at_s, decision_lines(one, start)) for one in simulation.decisions]
    rows += [
        (one.at_s, [f"{one.at_s - start:9.2f} s  {one.decision}: {one.verification.value}: {one.text}"])
        for one in simulation.checks
    ]
    rows += [
        (at, [f"{at - start:9.2f} s  {reaction} of {entity or 'the system'}: not done: {reason}"])
        for (reaction, entity, reason), at in simulation.withheld.items()
    ]
    for _, lines in sorted(rows):
        print("\n".join(lines))
    count = len(simulation.decisions)
    actions = "no action" if not count else "1 action" if count == 1 else f"{count} actions"
    print(f"{name}: {actions} in {end - start:.1f} s; nothing was done")


def decision_lines(decision: Decision, start: float) -> list[str]:
    """Return when an action would have been due, counted from ``start``, which one, and why."""
    target = f" {decision.action.target}" if decision.action.target is not None else ""
    head = f"{decision.at_s - start:9.2f} s  {decision.id}: {decision.action.kind}{target}"
    head += f": {decision.text}" if decision.text else ""
    lines = [head, *(f"{'':13}because {_words(one, start, decision.at_s)}" for one in decision.because)]
    cause = decision.first_cause
    return [*lines, f"{'':13}first cause {cause}"] if cause not in ("", decision.entity) else lines


def _words(because: Because, start: float, at: float) -> str:
    from roslens.live.react.value_words import value_words

    shown = value_words(because.value, because.quantity)
    value = f" ({because.quantity} {shown})" if shown else ""
    since = f" since {because.since - start:.2f} s" if start <= because.since < at else ""
    evidence = f": {because.evidence}" if because.evidence else ""
    return f"{because.entity} is {because.state}{value}{since}{evidence}"


def _print_json(runs: Sequence[_Run]) -> None:
    import msgspec

    def row(run: _Run) -> dict[str, Any]:
        name, start, end, simulation, _ = run
        return {
            "name": name,
            "start": start,
            "end": end,
            "decisions": simulation.decisions,
            "checks": simulation.checks,
            "withheld": [
                {"reaction": reaction, "entity": entity, "reason": reason, "at": at}
                for (reaction, entity, reason), at in simulation.withheld.items()
            ],
        }

    document = {"version": VERSION, "simulated": [row(run) for run in runs]}
    print(msgspec.json.format(msgspec.json.encode(document), indent=2).decode())
