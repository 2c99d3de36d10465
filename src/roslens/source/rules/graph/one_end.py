"""Rule ``graph.one_end``: a topic, service or action that only one side uses."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec

from roslens.model.configuration import Configuration, ConfiguredNode, Origin, Unresolved
from roslens.model.finding import Finding, RuleInfo, Severity
from roslens.model.graph import Role
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import (
    KIND,
    OTHER,
    WORDS,
    End,
    by_name,
    ends,
    is_launched,
    listed,
    missing_parts,
    unknown_nodes,
    unresolved_ends,
)
from roslens.source.rules.graph.likeness import alike, distance
from roslens.source.rules.graph.surroundings import Surroundings
from roslens.source.rules.graph.told import TOOL, told

RULE = RuleInfo(
    "graph.one_end",
    "One end only",
    "A topic, service or action is used by one side only: what is subscribed nobody publishes, what is called nobody "
    "serves, and the other way round, which is a note. Where the other side has a name that is nearly the same, or the "
    "same in another namespace, it is named as a candidate. Names whose other end is usually elsewhere are left out; "
    "`external` in `[options.graph]` says which.",
    Severity.WARNING,
    ("ros", "graph", "names", "connectivity"),
    "A name that is mistyped, remapped wrongly or in the wrong namespace joins nothing, and no node notices: "
    "a subscription waits for ever.",
    tool=TOOL,
    scope="configuration",
)
_WAITING = frozenset({Role.SUBSCRIPTION, Role.SERVICE_CLIENT, Role.ACTION_CLIENT})
_ORDINARY = frozenset({"std_msgs", "std_srvs", "example_interfaces", "geometry_msgs"})
_PARTS_OF_ACTION = frozenset({"goal", "cancel", "status", "result", "feedback"})


class _Candidate(msgspec.Struct, frozen=True, order=True):
    """The other end that may have been meant, the likeliest first; ``why`` in words."""

    rank: tuple[int, int, str]
    why: str
    name: str


class _View(msgspec.Struct, frozen=True):
    surroundings: Surroundings
    by_name: dict[tuple[str, str], list[End]]
    lonely: dict[tuple[str, str], list[End]]
    unknown: list[ConfiguredNode]
    unresolved: list[End]
    launched: bool
    missing: list[Unresolved]


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name with one end only; two of them that seem to mean each other are one finding."""
    named = by_name(ends(configuration))
    lonely = {
        key: of_name
        for key, of_name in named.items()
        if len({end.role for end in of_name}) == 1 and not surroundings.is_external(key[1])
    }
    launched = is_launched(configuration)
    view = _View(
        surroundings, named, lonely, unknown_nodes(configuration), unresolved_ends(configuration), launched,
        missing_parts(configuration),
    )  # fmt: skip
    paired: set[tuple[str, str]] = set()
    # Those that wait come first: what nobody hears is seldom what is wrong.
    for key, of_name in sorted(lonely.items(), key=lambda item: item[1][0].role not in _WAITING):
        if key in paired or _is_part_of_action(key, view) or _is_known_to_be_open(of_name):
            continue
        candidate = _candidate(of_name[0], view)
        if candidate is not None:
            paired.add((key[0], candidate.name))
        if candidate is not None or launched:
            yield _told(key, of_name, candidate, view)


def _is_part_of_action(key: tuple[str, str], view: _View) -> bool:
    """Whether it is one of the five topics of an action of ROS 1 that is known as such."""
    name, _, last = key[1].rpartition("/")
    return last in _PARTS_OF_ACTION and ("action", name) in view.by_name


def _is_known_to_be_open(of_name: list[End]) -> bool:
    """Whether only nodes from outside of the workspace use it: they offer more than one system needs.

    A name that they wait on is meant where the launch file chose it, by a parameter or a remapping.
    """
    return all(
        end.one.proof.origin is Origin.CATALOGUE and not (end.role in _WAITING and _is_chosen(end)) for end in of_name
    )


def _is_chosen(end: End) -> bool:
    return end.one.remapped is not None or (end.one.given != end.name and "set in " in end.one.proof.how)


def _candidate(end: End, view: _View) -> _Candidate | None:
    kind, wanted = KIND[end.role], OTHER[end.role]
    found_ones = []
    for (other_kind, name), of_name in view.by_name.items():
        if other_kind != kind or name == end.name:
            continue
        others = [one for one in of_name if one.role is wanted and _types_fit(end, one)]
        why = _why(end, name, lonely=(kind, name) in view.lonely) if others else ""
        if why:
            rank = (int((kind, name) not in view.lonely), distance(end.name, name, 30), name)
            found_ones.append(_Candidate(rank, why, name))
    return min(found_ones, default=None)


def _types_fit(one: End, other: End) -> bool:
    return not one.type or not other.type or one.type == other.type


def _why(end: End, name: str, *, lonely: bool) -> str:
    """Return in words why another name may be meant; empty where nothing speaks for it."""
    space, _, last = end.name.rpartition("/")
    other_space, _, other_last = name.rpartition("/")
    if alike(end.name, name) and lonely:
        return "nearly the same name"
    if last == other_last and end.type and lonely:
        return "the same name in another namespace"
    special = bool(end.type) and end.type.partition("/")[0] not in _ORDINARY
    if space == other_space and lonely and special and (last in other_last or other_last in last):
        return "the same type in the same namespace"
    return ""


def _told(key: tuple[str, str], of_name: list[End], candidate: _Candidate | None, view: _View) -> Finding:
    kind, name = key
    end = of_name[0]
    waits = end.role in _WAITING
    severity, doubt = weighed(
        RULE.severity if waits or candidate is not None else Severity.NOTE,
        (end.one.proof,),
        end.conditions,
        # A name that is nearly the same says more than that somebody unknown might be there.
        more=_missing(view) or (_more_doubt(end, view) if candidate is None else ""),
    )
    said = listed([f"{one.told} {WORDS[one.role]}" for one in of_name])
    missing = {"topic": ("publishes", "subscribes to"), "service": ("serves", "calls"), "action": ("serves", "calls")}
    nobody = missing[kind][0 if waits else 1]
    message = f"{said} {kind} {name}, which nobody {nobody}."
    if candidate is not None:
        others = listed([one.told for one in view.by_name[kind, candidate.name] if one.role is OTHER[end.role]])
        message += f" Candidate: {candidate.name} of {others}, {candidate.why}. Correct or remap one of the two names."
    elif waits:
        message += " Start what provides it, or correct the name."
    if not doubt and end.one.given and end.one.given != name:
        message += f" It is given as `{end.one.given}`."
    return told(RULE, message + doubt, end.one.proof, entity=end.entity, severity=severity, context=end.role.value)


def _missing(view: _View) -> str:
    """Return in words what of the configuration could not be followed; the other end may be there."""
    if not view.missing:
        return ""
    places = listed([f"`{one.text[:60]}` ({one.proof.place})" for one in view.missing])
    return f"the configuration is not whole: what {places} starts is unknown"


def _more_doubt(end: End, view: _View) -> str:
    """Return in words what may be the other end without being known."""
    if view.unknown:
        names = listed([node.name for node in view.unknown])
        return f"what {names} make{'s' if len(view.unknown) == 1 else ''} is unknown"
    wanted = OTHER[end.role]
    open_ends = [one for one in view.unresolved if one.role is wanted and _types_fit(end, one)]
    if open_ends:
        return f"the name is unknown of {listed([one.told for one in open_ends])}"
    return ""
