"""Nodes that were started twice: an alert without any constraint, for every name that several processes bear.

Topics, parameters and services of such nodes are mixed up, whatever each of them is worth. Hidden nodes (a name that
begins with ``_``) are left out: tools make one of the same name on each host.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from roslens.judge.reference.expectation import Details, PresenceMode, Timing
from roslens.live.standing.rulebook import NOTHING_KNOWN, Rulebook, find_all
from roslens.live.standing.silent_observer import blame
from roslens.live.standing.standing import Standing
from roslens.live.standing.verdict_state import NEVER
from roslens.live.window.observer_status import ObserverStatus
from roslens.model.entity import EntityId, EntityKind
from roslens.model.finding import Severity
from roslens.model.graph import Graph, Instance, Node
from roslens.model.verdict import State

LASTING_S = 2.0
"""A node that is started again while its former process ends is not there twice."""
UNPROVEN_S = 30.0
"""A participant whose process nobody sees may have crashed; the middleware misses it after its lease, 20 s by
default."""
MOST = 1_000
ID = "started_twice"


class _Twins(Standing):
    """A name, and who bears it."""

    __slots__ = ("instances",)

    def __init__(self, node: str, now: float) -> None:
        details = Details(ID, severity=Severity.WARNING, text="a node of this name was started more than once")
        super().__init__(EntityId(EntityKind.NODE, node), details, "presence", "<= 1", now)
        self.instances: tuple[Instance, ...] = ()

    def take(self, instances: tuple[Instance, ...]) -> None:
        """Note who bears the name now."""
        self.instances = instances
        proven = sum(one.pid > 0 for one in instances) > 1
        self.state.timing = Timing(lasting=LASTING_S if proven else UNPROVEN_S, recovering=LASTING_S)


class Twins:
    """The names that several nodes bear, and how long they have.

    Attributes:
        due: when one of them has to be judged again.
    """

    def __init__(self, rules: Rulebook, words: Callable[[Instance], str], old: Twins | None = None) -> None:
        """Begin with what ``old`` knows; ``words`` say where an instance runs."""
        self._rules = rules
        self._words = words
        self._by_name: dict[str, _Twins] = dict(old.by_name) if old else {}
        self._waiting: set[str] = set(self._by_name)
        self.due = NEVER

    @property
    def standing(self) -> list[Standing]:
        """Every name that was borne by several."""
        return [*self._by_name.values()]

    @property
    def by_name(self) -> Mapping[str, _Twins]:
        """The same by the name of the node."""
        return self._by_name

    def take(self, graph: Graph, now: float) -> None:
        """Take the names in a graph."""
        found = {node.name: node.instances for node in graph.nodes if node.instances and self._counts(node)}
        for name in found:
            if name not in self._by_name and len(self._by_name) < MOST:
                self._by_name[name] = _Twins(name, now)
        for name, one in self._by_name.items():
            instances = found.get(name, ())
            if instances != one.instances:
                one.take(instances)
                self._waiting.add(name)

    def look_again(self) -> None:
        """Judge all of them in the next tick."""
        self._waiting = set(self._by_name)

    def judge(self, now: float, silent_observer: Callable[[], ObserverStatus | None]) -> Iterable[Standing]:
        """Judge what has news or is due; return what changed."""
        if not self._waiting and now < self.due:
            return ()
        silent = silent_observer()
        changed = [one for one in self._by_name.values() if self._judge(one, now, silent)]
        self._waiting = set()
        self.due = min((one.state.due for one in self._by_name.values()), default=NEVER)
        return changed

    def _judge(self, one: _Twins, now: float, silent: ObserverStatus | None) -> bool:
        if silent is not None:
            blame(one, silent)
            return one.state.step(now, State.UNKNOWN, None)
        one.silent_observer = ""
        count = max(len(one.instances), 1)
        places = ", ".join(map(self._words, one.instances))
        one.evidence = f"{one.entity.name} is there {count} times: {places}" if count > 1 else "there once"
        return one.state.step(now, State.HIGH if count > 1 else State.OK, float(count))

    def _counts(self, node: Node) -> bool:
        """Whether a name is judged here: it is none of a tool, and no constraint asks for the same already."""
        if node.name.rpartition("/")[2].startswith("_"):
            return False
        facts = NOTHING_KNOWN._replace(hosts=frozenset(filter(None, (node.host,))))
        asked = find_all(self._rules.presences, EntityKind.NODE, node.name, facts)
        proven = sum(one.pid > 0 for one in node.instances) > 1
        return not proven or all(condition or one.mode is not PresenceMode.AT_MOST_ONE for one, condition in asked)
