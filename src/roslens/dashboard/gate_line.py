"""Whether a run passes, in one line: the first thing that a reader wants to know."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec

from roslens.judge.quality.gate import GateResult
from roslens.model.finding import Severity
from roslens.model.words.plural import plural

NEVER = "never"
_BEGINNINGS = {
    "passes": "Passes the gate",
    "fails": "Fails the gate",
    "cannot be determined": "Whether it passes the gate cannot be determined",
    "nothing fails it": "No finding fails it",
}


class GateLine(msgspec.Struct, frozen=True):
    """The answer (``passes``, ``fails`` or ``cannot be determined``) and what it rests on, a text each."""

    answer: str
    conditions: tuple[str, ...]

    @property
    def text(self) -> str:
        """The line: ``Fails the gate: 1 error``."""
        return f"{_BEGINNINGS[self.answer]}: {'; '.join(self.conditions)}"


def gate_line(severities: Mapping[Severity, int], fail_on: str, results: tuple[GateResult, ...] = ()) -> GateLine:
    """Return the line.

    Args:
        severities: how many findings count for gates, by severity.
        fail_on: severity from which findings fail a check; ``never`` for none.
        results: of the conditions of ``[gate]``.
    """
    texts = [one.text if _is_named(one) else f"{one.condition}: {one.text}" for one in results]
    verdicts = [one.holds for one in results]
    if fail_on != NEVER:
        least = Severity(fail_on)
        counted = {one: count for one, count in severities.items() if one.rank >= least.rank}
        texts.insert(0, ", ".join(plural(count, one.value) for one, count in counted.items()))
        verdicts.append(not any(counted.values()))
    if not verdicts:
        return GateLine("nothing fails it", ('fail_on is "never" in roslens.toml',))
    answer = "fails" if False in verdicts else "cannot be determined" if None in verdicts else "passes"
    return GateLine(answer, tuple(texts))


def _is_named(one: GateResult) -> bool:
    """Return whether the text names the condition by itself: ``1 new error`` names ``new_errors``."""
    return one.condition.replace("_", " ").removesuffix("s") in one.text
