"""Who is let in: what a server asks of those who want to view, and of those who want to act."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping

from roslens.dashboard.access.allowance import Allowance
from roslens.dashboard.access.audit import Entry, forgotten
from roslens.dashboard.access.person import Person
from roslens.dashboard.access.tokens import Tokens

MOST_REFUSED, REFUSED_EACH_S = 10, 6.0
MOST_ACTS, ACTS_EACH_S = 20, 3.0


class Access:
    """The rules of one server, and what it remembers of those who came."""

    def __init__(
        self,
        holders: Mapping[str, Person] | None = None,
        *,
        view_needs_token: bool = False,
        audit: Callable[[Entry], None] = forgotten,
        wall: Callable[[], float] = time.time,
        steady: Callable[[], float] = time.monotonic,
    ) -> None:
        """Take the rules.

        Args:
            holders: each token with who holds it; without an operator among them, no one may act.
            view_needs_token: whether who only looks needs one too.
            audit: called with each sign-in, each acting request and each refusal.
            wall: seconds since the epoch.
            steady: seconds that only grow.
        """
        self.tokens = Tokens(holders or {})
        self.view_needs_token = view_needs_token
        self.refusals = Allowance(MOST_REFUSED, REFUSED_EACH_S, steady)
        """The limit on wrong tokens or origins of a source; those beyond it are told to wait, and not written down."""
        self.acts = Allowance(MOST_ACTS, ACTS_EACH_S, steady)
        """Of acting requests."""
        self._audit = audit
        self._wall = wall

    def write_down(
        self, *, peer: str, person: Person | None, method: str, path: str, status: int, why: str = ""
    ) -> None:
        """Keep a record of a request."""
        name, role = (person.name, person.role.value) if person else ("", "")
        self._audit(Entry(self._wall(), peer, name, role, method[:16], path[:200], status, why))
