"""Tests of conditions: time lines beside references, each held against what it expects to be decided."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from roslens.live.react.simulation import Compared, Simulation

ENDING = ".test.yaml"


def beside(files: Sequence[str]) -> list[Path]:
    """Return the time lines that stand beside references: ``robot.test.yaml`` beside ``robot.yaml``."""
    from roslens.intake.is_there import is_file

    found = [Path(file).with_suffix("").with_suffix(ENDING) for file in files]
    return [path for path in dict.fromkeys(found) if is_file(path)]


def run_time_lines(files: Sequence[str], paths: Sequence[Path]) -> bool:
    """Print how each time line ended; return whether all of them are as expected.

    Raises:
        DocumentError: a document is wrong.
        UsageError: the references have no reaction.
    """
    from roslens.judge.reading.read_reference import load_reference
    from roslens.judge.reading.read_time_line import read_time_lines
    from roslens.live.react.simulation import compare, simulate
    from roslens.live.window.signals import BY_KEY
    from roslens.model.errors import UsageError

    reference = load_reference([Path(file) for file in files], BY_KEY)
    lines = [(path, line) for path in paths for line in read_time_lines(path)]
    if not reference.reactions:
        raise UsageError(f"time lines, and no reaction in {', '.join(files)}", expected="a document with `reactions`")
    failed = 0
    for path, line in lines:
        simulation = simulate(reference.reactions, line)
        outcome = compare(simulation.decisions, line.expected)
        failed += not outcome.passed
        print(f"{path}: {line.name}: {'as expected' if outcome.passed else 'not as expected'}")
        _print_differences(outcome)
        if not outcome.passed:
            _print_withheld(simulation)
    count = f"{len(lines)} time line{'' if len(lines) == 1 else 's'}"
    print(f"{count}, as expected" if not failed else f"{count}, {failed} of them not as expected")
    return not failed


def _print_differences(outcome: Compared) -> None:
    from roslens.cli.react.react_simulate import decision_lines

    for missing in outcome.missing:
        words = " ".join(filter(None, (missing.reaction, missing.action, missing.entity, missing.target)))
        print(
            f"roslens: {missing.place}: not decided: {words or 'an action'} at {missing.at_s:g} s "
            f"(within {missing.within_s:g} s)",
            file=sys.stderr,
        )
    for surplus in outcome.surplus:
        print("\n".join(["roslens: not expected:", *decision_lines(surplus, 0.0)]), file=sys.stderr)


def _print_withheld(simulation: Simulation) -> None:
    for (reaction, entity, reason), at in simulation.withheld.items():
        print(f"roslens: {at:.2f} s: {reaction} of {entity or 'the system'}: not done: {reason}", file=sys.stderr)
