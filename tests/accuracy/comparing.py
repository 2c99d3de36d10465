"""What source says beside what a running system shows: found, missed, said too much, said wrongly."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fnmatch import fnmatchcase

import msgspec

from accuracy.facts import KINDS, NODE, PARAMETER, Fact
from accuracy.system import Reason
from roslens.model.graph import Graph

IMPLICIT = "what every node has"
QOS = ("reliability", "durability", "liveliness", "deadline", "lifespan", "lease")
VALUES = {"type": "types", "hash": "MD5 or type hashes", "value": "values of parameters", **dict.fromkeys(QOS, "QoS")}
"""What is compared of an endpoint or parameter that both have, and its row."""
UNSEEN_ROS1 = frozenset({"service_client"})
"""A ROS 1 master knows nobody who calls a service, and nobody who reads a parameter."""


class Difference(msgspec.Struct, frozen=True):
    """A fact that only one side has, or of which a value is another.

    Attributes:
        fact: it.
        what: ``missed``, ``extra`` or ``other value``.
        text: in words.
        certain: whether source is certain of what it says.
        reason: why, where somebody found out.
    """

    fact: Fact
    what: str
    text: str
    certain: bool = False
    reason: Reason | None = None


class Row(msgspec.Struct):
    """Numbers of one kind of fact.

    Attributes:
        seen: facts of the running system that can be resolved.
        found: of them those that source says.
        said: facts that source says without a condition, in full.
        right: of them those that are there.
        conditional: facts that source says with a condition which nothing but a run decides, and that are not there.
        wrong: facts that source says, is certain of, and that are not so.
        aside: facts of the running system that cannot be resolved; each has its reason.
    """

    seen: int = 0
    found: int = 0
    said: int = 0
    right: int = 0
    conditional: int = 0
    wrong: int = 0
    aside: int = 0

    def add(self, other: Row) -> None:
        """Add the numbers of another row."""
        for name in self.__struct_fields__:
            setattr(self, name, getattr(self, name) + getattr(other, name))


class Comparison(msgspec.Struct):
    """Everything that is to be told of one system."""

    rows: dict[str, Row]
    differences: list[Difference]

    @property
    def unexplained(self) -> list[Difference]:
        """Return differences that nobody found the reason of."""
        return [one for one in self.differences if one.reason is None]

    @property
    def wrong(self) -> list[Difference]:
        """Return what source is certain of and is not so."""
        return [one for one in self.differences if one.certain]


def compare(
    shown: Sequence[Fact],
    told: Sequence[Fact],
    reasons: Sequence[Reason],
    generation: str,
    silent: frozenset[str] = frozenset(),
) -> Comparison:
    """Return how well source tells what a running system shows.

    Args:
        shown: by the running system.
        told: by source.
        reasons: why they differ.
        generation: ``ros1`` or ``ros2``.
        silent: nodes that do not tell their parameters.
    """
    shown = _known_by_pattern(shown, told)
    told = [one for one in told if one.kind != PARAMETER or one.node not in silent]
    found = _Comparing(reasons)
    by_key = {one.key: one for one in told if one.resolved}
    live = {one.key: one for one in shown}
    for one in shown:
        found.look(one, by_key.get(one.key), told)
    for one in told:
        if one.resolved and not (generation == "ros1" and one.kind in UNSEEN_ROS1):
            found.judge(one, live.get(one.key))
    return Comparison(found.rows, sorted(found.differences, key=lambda one: (one.what, one.fact.key, one.text)))


def silent_nodes(graph: Graph) -> frozenset[str]:
    """Return the nodes that do not tell their parameters: nobody spins them."""
    return frozenset(one.name for one in graph.nodes if graph.generation == "ros2" and one.name not in graph.parameters)


def _known_by_pattern(shown: Sequence[Fact], told: Sequence[Fact]) -> list[Fact]:
    """Return facts with the names of nodes that get a random end as source gives them: with ``*`` in place of it."""
    patterns = [one.node for one in told if one.kind == NODE and one.node.endswith("_*")]
    names: dict[str, str] = {}
    for one in shown:
        fits = [pattern for pattern in patterns if fnmatchcase(one.node, pattern)]
        if one.kind == NODE and len(fits) == 1:
            names[one.node] = fits[0]
    changed = []
    for one in shown:
        node = names.get(one.node, one.node)
        name = one.name
        if node != one.node and name.startswith(f"{one.node}/"):
            name = node + name[len(one.node) :]
        changed.append(msgspec.structs.replace(one, node=node, name=name))
    return changed


class _Comparing:
    def __init__(self, reasons: Sequence[Reason]) -> None:
        self._reasons = reasons
        self.rows: dict[str, Row] = {}
        self.differences: list[Difference] = []

    def look(self, one: Fact, said: Fact | None, told: Sequence[Fact]) -> None:
        """Take up what the running system shows."""
        row = self._row(_row_of(one, said))
        if said is not None:
            row.seen += 1
            row.found += 1
            return
        reason = self._reason(one, "missed")
        if reason is not None and reason.outside:
            row.aside += 1
        else:
            row.seen += 1
        text = str(one)
        patterns = [other for other in told if not other.resolved and _covers(other, one)]
        if patterns:
            text += f", which source knows as {patterns[0].given or patterns[0].name} ({patterns[0].place})"
        self.differences.append(Difference(one, "missed", text, reason=reason))

    def judge(self, one: Fact, live: Fact | None) -> None:
        """Take up what source says."""
        row = self._row(_row_of(one, one))
        if live is not None:
            row.said += 1
            row.right += 1
            self._values(one, live)
            return
        reason = self._reason(one, "extra")
        if one.conditions:
            row.conditional += 1
            text = f"{one}, which source makes depend on: {'; '.join(one.conditions)[:120]}"
            self.differences.append(Difference(one, "conditional", text, reason=reason or CONDITIONAL))
            return
        certain = one.sure == "certain" and not (reason is not None and reason.outside)
        if not (reason is not None and reason.outside):
            row.said += 1
        row.wrong += certain
        text = f"{one} ({one.place}), {one.sure}"
        self.differences.append(Difference(one, "extra", text, certain, reason))

    def _values(self, one: Fact, live: Fact) -> None:
        for name in sorted(one.values.keys() | live.values.keys()):
            says, is_so = one.values.get(name, ""), live.values.get(name, "")
            if not is_so or (name == "hash" and not says):
                continue
            row = self._row(IMPLICIT if one.implicit else VALUES[name])
            same = _same(name, says, is_so)
            reason = None if same else self._reason(one, name)
            if reason is not None and reason.outside:
                row.aside += 1
                self._other(one, name, says, is_so, reason, certain=False)
                continue
            row.seen += 1
            row.found += same
            row.right += same
            row.said += bool(says)
            if not same:
                certain = bool(says) and one.sure == "certain" and not one.conditions
                row.wrong += certain
                self._other(one, name, says, is_so, reason, certain=certain)

    def _other(self, one: Fact, name: str, says: str, is_so: str, reason: Reason | None, *, certain: bool) -> None:
        text = f"{name} of {one}: {is_so!r}, source says {says!r}" if says else f"{name} of {one}: {is_so!r}"
        self.differences.append(Difference(one, "other value" if says else "missed", text, certain, reason))

    def _reason(self, one: Fact, what: str) -> Reason | None:
        return next((reason for reason in self._reasons if reason.holds(one, what)), None)

    def _row(self, name: str) -> Row:
        return self.rows.setdefault(name, Row())


CONDITIONAL = Reason(cause="conditional", why="Source says so: only a run decides the condition.")


def _same(name: str, says: str, is_so: str) -> bool:
    """Tell whether two values are one: 0.10 is written where 0.1 is shown, but 1 is no 1.0."""
    if says == is_so or name != "value" or "." not in says or "." not in is_so:
        return says == is_so
    try:
        return float(says) == float(is_so)
    except ValueError:
        return False


def _covers(pattern: Fact, one: Fact) -> bool:
    return pattern.kind == one.kind and fnmatchcase(one.node, pattern.node) and fnmatchcase(one.name, pattern.name)


_EVERY = (
    "/rosout", "/parameter_events", "/get_loggers", "/set_logger_level", "/describe_parameters", "/get_parameters",
    "/get_parameter_types", "/list_parameters", "/set_parameters", "/set_parameters_atomically",
    "/get_type_description",
)  # fmt: skip


def _row_of(one: Fact, said: Fact | None) -> str:
    if said is not None and said.implicit:
        return IMPLICIT
    if said is None and one.kind not in (NODE, PARAMETER) and one.name.removeprefix(one.node) in _EVERY:
        return IMPLICIT
    return one.kind


def total(rows: Iterable[dict[str, Row]]) -> dict[str, Row]:
    """Return the numbers of several systems together, kinds in their order."""
    sums: dict[str, Row] = {}
    for one in rows:
        for name, row in one.items():
            sums.setdefault(name, Row()).add(row)
    order = [*KINDS, IMPLICIT, *dict.fromkeys(VALUES.values())]
    return {name: sums[name] for name in order if name in sums}
