"""How old data is at the end of a path of topics."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise

from roslens.judge.reference.expectation import AgeChain, essence
from roslens.live.standing.ready_constraint import Bounds
from roslens.live.standing.standing import Standing
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State

Look = Callable[[str, str], "float | None"]
"""Returns a signal of a topic, None where nothing is known of it."""
Silence = Callable[[str], float]
"""Returns for how many seconds a topic has been silent for longer than is usual of it."""


def age_at_end(topics: Sequence[str], look: Look) -> tuple[float | None, str]:
    """Return the age of data on the last topic, counted from its stamp on the first, and how that is known.

    Where ages of headers never fall along the path, the stamp is handed on and the last age is the answer. Where the
    nodes stamp anew, it is the age on the first topic, plus for each node on the way the time it takes to answer, plus
    the latency of its answer. None where a link of the path cannot be seen.
    """
    ages = [look(topic, "age") for topic in topics]
    if None not in ages:
        known = [age for age in ages if age is not None]
        if all(later >= earlier for earlier, later in pairwise(known)):
            return known[-1], "by the stamps in the headers"
    age = ages[0]
    if age is None:
        return None, f"no stamp is seen on {topics[0]}"
    for before, after in pairwise(topics):
        processing, latency = look(before, "processing"), look(after, "latency")
        if processing is None:
            return None, f"the time from {before} to {after} cannot be seen"
        if latency is None:
            return None, f"the latency of {after} cannot be seen"
        age += processing + latency
    return age, "age on the first topic, processing and latency along the path"


class AgeChains:
    """The chains of a reference and how they stand."""

    def __init__(self, chains: Iterable[AgeChain], now: float, old: AgeChains | None = None) -> None:
        """Begin with what is expected; what ``old`` has too keeps its state."""
        known: dict[AgeChain, _Watched] = {essence(one.chain): one for one in old.standing} if old else {}
        self.standing: list[_Watched] = []
        for chain in chains:
            watched = known.get(essence(chain)) or _Watched(chain, now)
            watched.chain, watched.details = chain, chain.details
            self.standing.append(watched)

    def judge(self, now: float, look: Look, silence: Silence, appeared: float) -> list[Standing]:
        """Judge every chain; return what changed."""
        changed: list[Standing] = []
        for one in self.standing:
            value, one.evidence = one.age(now, look, silence)
            raw = one.bounds.state(value)
            firm = one.bounds.firm(value, one.state.state)
            if one.state.step(now, raw, value, firm=firm, grace=appeared + one.details.timing.grace):
                changed.append(one)
        return changed


class _Watched(Standing):
    __slots__ = ("_known", "bounds", "chain")

    def __init__(self, chain: AgeChain, now: float) -> None:
        entity = EntityId(EntityKind.TOPIC, chain.topics[-1])
        super().__init__(entity, chain.details, "age", chain.written or str(chain.range), now)
        self.chain = chain
        self.bounds = Bounds(chain.range, chain.details.timing.margin)
        self._known: tuple[float, float] | None = None

    def forget(self, now: float, state: State) -> None:
        """Begin anew in ``state``, because time itself broke."""
        super().forget(now, state)
        self._known = None

    def age(self, now: float, look: Look, silence: Silence) -> tuple[float | None, str]:
        """Return the age at the end, and how that is known: where a topic of the path fell silent, data grows older."""
        value, evidence = age_at_end(self.chain.topics, look)
        quiet, topic = max((silence(topic), topic) for topic in self.chain.topics)
        if value is not None:
            self._known = value, now - quiet
        if not quiet or self._known is None:
            return value, evidence
        value, at = self._known
        return value + now - at, f"{topic} has been silent for {quiet:.1f} s"
