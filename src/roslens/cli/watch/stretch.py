"""How long to watch: from the first observation, until the time is over or it is stopped."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from roslens.model.failure import Failure

if TYPE_CHECKING:
    from roslens.live.join.session import Session


class Stretch:
    """Ends after so many seconds; an observer takes one to start, and ten on a busy machine, that do not count."""

    def __init__(
        self, session: Session, seconds: float | None, ended: Sequence[int], *,
        steady: Callable[[], float] = time.monotonic,
    ) -> None:  # fmt: skip
        """Watch until ``ended`` holds something, or for ``seconds``; None for ever."""
        self._session = session
        self._seconds = seconds
        self._ended = ended
        self._steady = steady
        self._started = steady()
        self._begun: float | None = None

    def over(self, _: float = 0.0) -> bool:
        """Return whether it is over."""
        if self._begun is None and self._session.begun:
            self._begun = self._steady()
        if self._ended or self._seconds is None or self._begun is None:
            return bool(self._ended)
        return self._steady() - self._begun >= self._seconds

    @property
    def seen(self) -> float:
        """Seconds since the first observation; 0 where there was none."""
        return 0.0 if self._begun is None else self._steady() - self._begun

    @property
    def passed(self) -> float:
        """Seconds since it started, whoever saw something or not."""
        return self._steady() - self._started


def blind(sources: Sequence[object]) -> list[str]:
    """Return the names of the observers that have not said yet who is there."""
    return [str(getattr(one, "tool", "")) for one in sources if not getattr(one, "seeing", True)]


def never_saw(sources: Sequence[object], seconds: float) -> tuple[Failure, ...]:
    """Return a failure for each observer that has not said who is there when a watch of ``seconds`` ends."""
    return tuple(
        Failure(tool, f"the observer of {tool} has said nothing in {seconds:.0f} s", "who is there", "Watch for longer")
        for tool in blind(sources)
    )
