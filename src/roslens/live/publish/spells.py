"""How long what was wrong had been so when it is fine again."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.model.verdict import State, Verdict

_OPEN = (State.UNKNOWN, State.SUSPENDED)


class Spells:
    """Remembers since when each broken constraint is broken."""

    def __init__(self) -> None:
        self._since: dict[tuple[str, str], float] = {}

    def ended(self, changes: Iterable[Verdict]) -> dict[tuple[str, str], float]:
        """Return for each change that ends something wrong how many seconds that had lasted, by entity and constraint.

        What goes from one wrong state to another goes on being wrong; what is unknown in between did, as far as anybody
        knows.
        """
        found = {}
        for one in changes:
            key = key_of(one)
            if one.wrong:
                self._since.setdefault(key, one.since)
            elif one.state not in _OPEN and key in self._since:
                found[key] = max(one.since - self._since.pop(key), 0.0)
        return found


def key_of(verdict: Verdict) -> tuple[str, str]:
    """Return by what a verdict is known as the same: its entity and its constraint."""
    return str(verdict.entity), verdict.expectation
