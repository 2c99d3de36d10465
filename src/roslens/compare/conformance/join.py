"""Joins sides by kind, node and name, and finds their differences."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence

import msgspec

from roslens.compare.conformance import explain
from roslens.compare.conformance.asked import asked, with_asked
from roslens.compare.conformance.claim import NODE, TOPIC, Claim, Key
from roslens.compare.conformance.disparity import ABSENT, NOT_KNOWN, Aspect, Conformance, Disparity, Why
from roslens.compare.conformance.plumbing import plumbing
from roslens.compare.conformance.renaming import known_by_pattern, renamed, same_ends, same_nodes
from roslens.compare.conformance.side import Side, SideKind
from roslens.model.errors import UsageError
from roslens.model.graph import Role

MOST_SIDES = 3
_ORDER = (SideKind.SOURCE, SideKind.RUNNING, SideKind.RECORDING)
_ASPECTS = frozenset(one.value for one in Aspect)
_HIDDEN = "***"
"""In place of the value of a parameter whose name is that of a secret."""
_CUT = "…"
"""At the end of a value of which the rest is left out."""


def conformance(sides: Sequence[Side]) -> Conformance:
    """Return where two or three sides differ.

    Raises:
        UsageError: there are fewer or more, or only references.
    """
    if not 2 <= len(sides) <= MOST_SIDES:
        raise UsageError(f"{len(sides)} sides to compare", expected="two or three")
    real = [one for one in sides if one.kind is not SideKind.REFERENCE]
    if not real:
        raise UsageError("only references to compare", expected="source, a running system or a recording too")
    _same_generation(real)
    joined = _Join(sides)
    found = [*joined.names, *joined.rows()] if len(real) > 1 else []
    notes: list[str] = []
    for side in sides:
        if side.kind is SideKind.REFERENCE:
            more, covered = asked(side, sides)
            found = with_asked(found, more)
            notes += covered
    return Conformance(
        tuple(one.title for one in sides),
        tuple(one.kind.value for one in sides),
        tuple(sorted(found, key=lambda one: one.order)),
        dict(sorted(joined.agreed.items())),
        tuple(notes),
    )


def _same_generation(real: Sequence[Side]) -> None:
    known = {one.generation: one.title for one in real if one.generation in ("ros1", "ros2")}
    if len(known) > 1:
        said = " and ".join(f"{title} of {name.replace('ros', 'ROS ')}" for name, title in sorted(known.items()))
        raise UsageError(
            f"{said} were given",
            expected="sides of one generation of ROS",
            advice="Choose a configuration, or record a robot, of the same generation",
        )


class _Join:
    """Aligns names, and compares the claims of all sides.

    Attributes:
        names: differences of names.
        agreed: how many of each kind at least two sides have in common.
    """

    def __init__(self, sides: Sequence[Side]) -> None:
        self.sides = tuple(sides)
        self.names: list[Disparity] = []
        self.agreed: Counter[str] = Counter()
        self._own_names: dict[tuple[int, str], str] = {}
        self._sizes: dict[tuple[int, str], int] = {}
        self._real = sorted(
            (place for place, one in enumerate(sides) if one.kind is not SideKind.REFERENCE),
            key=lambda place: (_ORDER.index(sides[place].kind), place),
        )
        self._claims: dict[int, dict[Key, Claim]] = {}
        if len(self._real) > 1:
            self._align()

    def _align(self) -> None:
        """Take the claims of all sides under the names of the first that has them."""
        first = self._real[0]
        base = self.sides[first].claims
        self._claims[first] = {one.key: one for one in base if one.resolved}
        for place in self._real[1:]:
            other = known_by_pattern(self.sides[place].claims, base)
            if self.sides[place].whole and self.sides[first].whole:
                other = self._with_same_names(first, base, place, other)
            self._claims[place] = {one.key: one for one in other if one.resolved}

    def _with_same_names(
        self, first: int, base: Sequence[Claim], place: int, other: Sequence[Claim]
    ) -> tuple[Claim, ...]:
        names = same_nodes(base, other)
        of_base = {one.key: one for one in base}
        for theirs, ours in sorted(names.items()):
            self._own_names[place, ours] = theirs
            why = explain.other_name(self._of_source(first, of_base.get((NODE, ours, ""))), of_node=True)
            self.names.append(self._named(NODE, ours, "", {first: ours, place: theirs}, why))
        aligned = renamed(other, names)
        ends = same_ends([*base], [*aligned])
        kept = []
        for one in aligned:
            match = ends.get(one.key)
            if match is None:
                kept.append(one)
                continue
            why = explain.other_name(self._of_source(first, match), of_node=False)
            values = {first: match.name, place: one.name}
            self.names.append(self._named(one.kind, match.node, match.name, values, why))
            kept.append(msgspec.structs.replace(one, name=match.name))
        return tuple(kept)

    def _of_source(self, place: int, claim: Claim | None) -> Claim | None:
        return claim if self.sides[place].kind is SideKind.SOURCE else None

    def _named(self, kind: str, node: str, name: str, values: Mapping[int, str], why: Why) -> Disparity:
        cells = tuple(values.get(place, NOT_KNOWN) for place in range(len(self.sides)))
        return Disparity(kind, node, name, Aspect.NAME, cells, why.reason, why.right, why.text, why.severity, why.place)

    def rows(self) -> Iterator[Disparity]:
        """Yield the differences of all claims, names aside."""
        nameless = [place for place in self._real if Role.PUBLISHER.value not in self.sides[place].knows]
        self._count_parts()
        for key in sorted({key for claims in self._claims.values() for key in claims}):
            there = {place: self._claims[place][key] for place in self._real if key in self._claims[place]}
            if any(plumbing(one) for one in there.values()):
                continue
            if key[0] == TOPIC and not nameless:
                continue
            asked_of = [place for place in self._real if self._tells(place, key, there)]
            if len(asked_of) < 2:
                continue
            yield from self._row(key, there, asked_of, nameless)

    def _tells(self, place: int, key: Key, there: Mapping[int, Claim]) -> bool:
        """Return whether a side would have the claim: of a node that it lacks, only the lack is reported."""
        kind, node, _ = key
        if place in there:
            return True
        side = self.sides[place]
        if not side.tells(kind, self._own_name(place, node)):
            return False
        known = NODE in side.knows and side.whole
        return kind == NODE or not node or not known or (NODE, node, "") in self._claims[place]

    def _own_name(self, place: int, node: str) -> str:
        """Return what a side itself calls a node of the first one."""
        return self._own_names.get((place, node), node)

    def _row(
        self, key: Key, there: Mapping[int, Claim], asked_of: Sequence[int], nameless: Sequence[int]
    ) -> Iterator[Disparity]:
        absent = [place for place in asked_of if place not in there]
        others = [place for place in absent if self._matters(key, place)]
        if key[0] == TOPIC and not set(nameless) & {*others, *(there if others else ())}:
            # Between sides that name nodes, the endpoints show it.
            others = []
        if others:
            why = self._why(key, there, others)
            cells = dict.fromkeys(absent, ABSENT) | {place: _shown(one) for place, one in there.items()}
            yield self._stated(key, Aspect.PRESENCE, cells, why, also=self._parts(key, there))
        differing = list(self._values(key, there, nameless))
        yield from differing
        if not others and not differing and len(there) > 1:
            self.agreed[key[0]] += 1

    def _matters(self, key: Key, place: int) -> bool:
        """Return whether that a side lacks it is worth a word: a recording names only nodes that published."""
        return self.sides[place].whole or key[0] != NODE

    def _parts(self, key: Key, there: Mapping[int, Claim]) -> int:
        kind, node, _ = key
        if kind != NODE:
            return 0
        return self._sizes.get((min(there), node), 0)

    def _count_parts(self) -> None:
        for place, claims in self._claims.items():
            for one in claims.values():
                if one.node and one.kind != NODE and not plumbing(one):
                    self._sizes[place, one.node] = self._sizes.get((place, one.node), 0) + 1

    def _why(self, key: Key, there: Mapping[int, Claim], absent: Sequence[int]) -> Why:
        has = min(there, key=lambda place: (_ORDER.index(self.sides[place].kind), place))
        lacks = min(absent, key=lambda place: (_LACKING.index(self.sides[place].kind), place))
        one, side, lacking = there[has], self.sides[has], self.sides[lacks]
        if side.kind is lacking.kind and (side.kind is not SideKind.RECORDING or (side.whole and lacking.whole)):
            return explain.only_one_of_a_kind(one, side.kind, side.title)
        if lacking.kind is SideKind.SOURCE:
            same = [other for other in self._claims[lacks].values() if other.node == one.node]
            return explain.not_in_source(one, lacking, same)
        if lacking.kind is SideKind.RECORDING and not lacking.whole:
            return explain.not_recorded(one)
        if side.kind is SideKind.RECORDING and not side.whole:
            return explain.recorded_only(side.title)
        node = self._claims[lacks].get((NODE, key[1], "")) if key[0] != NODE else None
        return explain.not_running(one, node)

    def _values(self, key: Key, there: Mapping[int, Claim], nameless: Sequence[int]) -> Iterator[Disparity]:
        if key[0] == TOPIC and not set(nameless) & there.keys():
            return
        names = sorted({name for one in there.values() for name in one.values} & _ASPECTS)
        for name in names:
            stated = {place: one.values[name] for place, one in there.items() if _is_known(one.values.get(name, ""))}
            if len(stated) < 2 or _all_same(name, [*stated.values()]):
                continue
            source = next((there[at] for at in stated if self.sides[at].kind is SideKind.SOURCE), None)
            other = next((there[at] for at in stated if self.sides[at].kind is not SideKind.SOURCE), None)
            yield self._stated(key, Aspect(name), stated, explain.other_value(name, source, other))

    def _stated(self, key: Key, aspect: Aspect, values: Mapping[int, str], why: Why, also: int = 0) -> Disparity:
        kind, node, name = key
        cells = tuple(values.get(place, NOT_KNOWN) for place in range(len(self.sides)))
        return Disparity(
            kind, node, name, aspect, cells, why.reason, why.right, why.text, why.severity, why.place, also
        )


_LACKING = (SideKind.RUNNING, SideKind.SOURCE, SideKind.RECORDING)


def _shown(one: Claim) -> str:
    stated = one.values.get("program") or one.values.get("type") or one.values.get("value")
    return stated or "there"


def _is_known(value: str) -> bool:
    return bool(value) and value != "*" and _HIDDEN not in value and not value.endswith(_CUT)


def _all_same(name: str, values: Sequence[str]) -> bool:
    same: Callable[[str, str], bool] = _same_number if name == Aspect.VALUE.value else str.__eq__
    return all(same(values[0], one) for one in values[1:])


def _same_number(one: str, other: str) -> bool:
    """Return whether two values are equal: 0.10 equals 0.1, but 1 does not equal 1.0."""
    if one == other or "." not in one or "." not in other:
        return one == other
    try:
        return float(one) == float(other)
    except ValueError:
        return False
