"""The answers of `roslens why` about what a page shows: of what runs from its newest look, else of a recording."""

from __future__ import annotations

import os
import threading
from collections import deque
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import msgspec

from roslens.cli.page.half_lines import ends_of
from roslens.compare.why.answered import answer
from roslens.compare.why.apart import DISCOVERY, DOMAIN, RMW
from roslens.compare.why.observed import Ended, Observed
from roslens.compare.why.question import Question
from roslens.live.agent.ros_environments import RosEnvironments, ros_environments
from roslens.model.acting.process_end import end_words
from roslens.model.answers.answer import Answer
from roslens.model.entity import EntityId, EntityKind
from roslens.model.errors import UsageError
from roslens.model.graph import Change, Graph
from roslens.report.why.answer_text import to_answer_json

if TYPE_CHECKING:
    from collections.abc import Sequence

    from roslens.cli.page.board_page import Looked
    from roslens.compare.why.declared import Declared
    from roslens.compare.why.recorded import Recorded
    from roslens.dashboard.live.snapshot import Alert
    from roslens.live.join.session import Step
    from roslens.live.system.tree import SystemView

MOST_ALERTS = 20
"""Alerts of which the first cause is told with them; of the others it is where one asks for it."""
_MOST_ENDED = 200
_PROCESSES_S = 10.0
"""How long what other programs run is taken for true."""
_ASKED_OF = frozenset({EntityKind.TOPIC, EntityKind.NODE, EntityKind.SERVICE, EntityKind.ACTION})


class WhyPage:
    """Answers why something is as it is; may be asked from any thread.

    Attributes:
        declared: returns what source says of an entity; None where no source is shown beside.
        recorded: returns what is shown, of a recording; None of a system that runs.
    """

    def __init__(
        self, looked: Callable[[], Looked | None], *, steady: Callable[[], float], live: bool,
        processes: Callable[[], RosEnvironments] = ros_environments,
        environment: Mapping[str, str] = os.environ,
    ) -> None:  # fmt: skip
        """Answer from the newest look.

        Args:
            looked: returns it.
            steady: a monotonic clock.
            live: whether it is of a system that runs here.
            processes: returns the programs of ROS 2 on this host.
            environment: of the observers.
        """
        self._looked = looked
        self._steady = steady
        self._live = live
        self._find_processes = processes
        self._here = {name: environment.get(name, "") for name in (DOMAIN, RMW, DISCOVERY)}
        self._ended: deque[Ended] = deque(maxlen=_MOST_ENDED)
        self._processes = RosEnvironments()
        self._processes_due = float("-inf")
        self._causes: dict[tuple[str, str, str], str] = {}
        self._graph: Graph | None = None
        self._lock = threading.Lock()
        self.declared: Callable[[str], Declared | None] | None = None
        self.recorded: Callable[[], Recorded] | None = None

    def look_in(self, domain: int | None) -> None:
        """Let the observers be in a domain; None is that of their environment."""
        if domain is not None:
            self._here[DOMAIN] = str(domain)

    def take(self, step: Step) -> None:
        """Remember which nodes ended."""
        for one in step.events:
            if one.change is Change.VANISHED and one.entity.startswith("node:"):
                how = end_words(one.ended) if one.ended else one.detail
                self._ended.append(Ended(one.entity.removeprefix("node:"), how, one.said))

    def page(self, entity: str) -> bytes:
        """Return the answer about an entity as JSON; empty where nothing can be said of it."""
        found = self.answer(entity)
        return to_answer_json(found).encode() if found is not None else b""

    def answer(self, entity: str) -> Answer | None:
        """Return the answer about an entity by the text form of its id; None where nothing can be said of it."""
        asked = _asked(entity)
        if asked is None:
            return None
        with self._lock:
            declared = self.declared(asked.entity) if self.declared is not None else None
            recorded = self.recorded() if self.recorded is not None else None
            observed = self._observed() if self._live else None
        try:
            return answer(asked, declared, recorded, observed)
        except UsageError:
            return None

    def told(self, alerts: Sequence[Alert]) -> tuple[Alert, ...]:
        """Return alerts with the first cause of each of the first of them; a cause is looked for once in a graph."""
        looked = self._looked()
        if not self._live or looked is None:
            return tuple(alerts)
        if looked.graph is not self._graph:
            self._graph = looked.graph
            self._causes.clear()
        first = [msgspec.structs.replace(one, why=self._cause(one)) for one in alerts[:MOST_ALERTS]]
        return (*first, *alerts[MOST_ALERTS:])

    def _cause(self, alert: Alert) -> str:
        key = (alert.entity, alert.key, alert.state)
        if key not in self._causes:
            found = self.answer(alert.entity)
            self._causes[key] = found.cause.says if found is not None and found.cause is not None else ""
        return self._causes[key]

    def _observed(self) -> Observed | None:
        looked = self._looked()
        if looked is None:
            return None
        now = self._steady()
        if now >= self._processes_due:
            self._processes, self._processes_due = self._find_processes(), now + _PROCESSES_S
        there = {one.name for one in looked.graph.nodes}
        latest = {one.node: one for one in self._ended if one.node not in there}
        return Observed(
            "what runs here", looked.graph, _values(looked.view), ended=tuple(latest.values()),
            processes=self._processes.processes, unreadable=self._processes.unreadable,
            closed_memory=self._processes.closed_memory, routers=self._processes.routers, user=os.getuid(),
            here=self._here,
        )  # fmt: skip


def _asked(entity: str) -> Question | None:
    """Return what is asked about: of a connection its topic; None of what no answer is about."""
    try:
        found = EntityId.parse(entity)
    except ValueError:
        return None
    if found.kind is EntityKind.CONNECTION:
        return Question("topic", ends_of(entity)[0])
    return Question(found.kind.value, found.name) if found.kind in _ASKED_OF else None


def _values(view: SystemView) -> dict[str, Mapping[str, float]]:
    found: dict[str, Mapping[str, float]] = {}
    waiting = [view]
    while waiting:
        part = waiting.pop()
        if part.values:
            found[part.id] = part.values
        waiting += part.children
    return found
