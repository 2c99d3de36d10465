"""Why the other end of a name should be there, in a configuration of which nobody says that it is whole."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import msgspec

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter, Origin, Unresolved
from roslens.model.graph import Role
from roslens.model.graphs.end import KIND, OTHER, VERB, End
from roslens.source.rules.graph.ends import is_unknown, listed, missing_parts, unknown_nodes, unresolved_ends
from roslens.source.rules.graph.likeness import alike, distance

WAITING = frozenset({Role.SUBSCRIPTION, Role.SERVICE_CLIENT, Role.ACTION_CLIENT})
_ORDINARY = frozenset({"std_msgs", "std_srvs", "example_interfaces", "geometry_msgs"})
_FAR = 30


class Expected(msgspec.Struct, frozen=True):
    """What says that the other end is expected.

    Attributes:
        words: what was found and what to do, as sentences.
        name: the other name that may have been meant; empty where it is another reason.
        doubt: why it may not hold; empty where nothing speaks against it.
    """

    words: str
    name: str = ""
    doubt: str = ""


class View(msgspec.Struct, frozen=True):
    """What of a configuration decides whether the other end of a name is expected.

    Attributes:
        by_name: all ends of which the name is known.
        lonely: those of names that one side uses.
        implicit: names that nodes have without their code saying so.
        owners: nodes of which all ends are known, by name.
        named: by name the nodes to which a parameter gives it, with the parameter.
        unknown: nodes of which nobody knows what they make.
        unresolved: ends of which a part of the name is unknown.
        missing: what may start further nodes.
    """

    by_name: Mapping[tuple[str, str], list[End]]
    lonely: Mapping[tuple[str, str], list[End]]
    implicit: frozenset[tuple[str, str]]
    owners: Mapping[str, ConfiguredNode]
    named: Mapping[str, Sequence[tuple[ConfiguredNode, ConfiguredParameter]]]
    unknown: Sequence[ConfiguredNode]
    unresolved: Sequence[End]
    missing: Sequence[Unresolved]


class _Candidate(msgspec.Struct, frozen=True, order=True):
    """The other end that may have been meant, the likeliest first; ``why`` in words."""

    rank: tuple[int, str]
    why: str
    name: str


def view_of(
    configuration: Configuration,
    named: Mapping[tuple[str, str], list[End]],
    lonely: Mapping[tuple[str, str], list[End]],
) -> View:
    """Return the view of a configuration with its ends by kind and name."""
    unresolved = unresolved_ends(configuration)
    not_understood = {one.node for one in configuration.unresolved if one.node} | {one.node.name for one in unresolved}
    read = [
        node
        for node in configuration.nodes
        if node.resolved and not is_unknown(node) and node.defined is not None and node.defined.origin is Origin.CODE
    ]
    owners = {node.name: node for node in read if node.name not in not_understood}
    implicit = frozenset(
        (KIND[one.endpoint.role], one.endpoint.name)
        for node in configuration.nodes
        for one in node.endpoints
        if one.implicit
    )
    return View(
        named, lonely, implicit, owners, _named_by_parameters(read), unknown_nodes(configuration), unresolved,
        missing_parts(configuration),
    )  # fmt: skip


def expected(of_name: Sequence[End], view: View) -> Expected | None:
    """Return why the other end of a name is expected; None where nothing says so.

    Args:
        of_name: the ends that there are, all of one side, the clearest first.
        view: the configuration.
    """
    return _by_candidate(of_name, view) or _by_owner(of_name, view) or _by_parameter(of_name, view)


def types_fit(one: End, other: End) -> bool:
    """Return whether two ends have one type, as far as their types are known."""
    return not one.type or not other.type or one.type == other.type


def _by_candidate(of_name: Sequence[End], view: View) -> Expected | None:
    end = of_name[0]
    kind, wanted = KIND[end.role], OTHER[end.role]
    own = {one.node.name for one in of_name}
    candidates = []
    for (other_kind, name), others in view.lonely.items():
        fit = [one for one in others if one.role is wanted and types_fit(end, one) and one.node.name not in own]
        if other_kind == kind and name != end.name and fit and (why := _why(end, fit[0], name)):
            candidates.append(_Candidate((distance(end.name, name, _FAR), name), why, name))
    if not candidates:
        return None
    best = min(candidates)
    whose = listed([one.label for one in view.lonely[kind, best.name] if one.role is wanted])
    words = f"Candidate: {best.name} of {whose}, {best.why}. Correct or remap one of the two names."
    return Expected(words, best.name)


def _why(end: End, other: End, name: str) -> str:
    """Return in words why another name may be meant; empty where nothing speaks for it."""
    space, _, last = end.name.rpartition("/")
    other_space, _, other_last = name.rpartition("/")
    same_type = bool(end.type) and end.type == other.type
    if alike(end.name, name) and _letters(end.name) != _letters(name):
        return "nearly the same name"
    if last == other_last and same_type:
        return "the same name in another namespace"
    special = same_type and end.type.partition("/")[0] not in _ORDINARY
    if space == other_space and special and (_is_part(last, other_last) or _is_part(other_last, last)):
        return "the same type in the same namespace"
    return ""


def _is_part(one: str, other: str) -> bool:
    """Whether the words of one name are among those of another."""
    return f"_{one}_" in f"_{other}_"


def _letters(name: str) -> str:
    """Return a name without its numbers: those count things that are alike."""
    return "".join(sign for sign in name if not sign.isdigit())


def _by_owner(of_name: Sequence[End], view: View) -> Expected | None:
    """Return that a name belongs to a node which has none of it."""
    end = of_name[0]
    owner = view.owners.get(end.name.rpartition("/")[0])
    if owner is None or end.role not in WAITING or any(one.node.name == owner.name for one in of_name):
        return None
    verb = VERB[OTHER[end.role]]
    own = [f"`{one}`" for one in sorted(_own(owner, OTHER[end.role]))]
    has = f"it {verb} {listed(own)}" if own else f"it {verb} none below its name"
    return Expected(
        f"The name is below that of {owner.name} ({owner.proof.place}), which has none of it: {has}. Correct the name, "
        f"or let {owner.name} have it."
    )


def _named_by_parameters(
    nodes: Sequence[ConfiguredNode],
) -> dict[str, list[tuple[ConfiguredNode, ConfiguredParameter]]]:
    """Return the nodes whose parameters are set to a global name, by that name."""
    found: dict[str, list[tuple[ConfiguredNode, ConfiguredParameter]]] = {}
    for node in nodes:
        for one in node.parameters:
            # A name with a slash in front is one of ROS 1, where a node may have parameters of others too.
            own = not one.name.startswith("/") or one.name.startswith(f"{node.name}/")
            if own and one.set_by is not None and one.value and one.value.startswith("/"):
                found.setdefault(one.value, []).append((node, one))
    return found


def _by_parameter(of_name: Sequence[End], view: View) -> Expected | None:
    """Return that a node is given a name by a parameter and does not use it."""
    own = {one.node.name for one in of_name}
    for node, one in view.named.get(of_name[0].name, ()):
        if node.name not in own and one.set_by is not None:
            doubt = "" if node.name in view.owners else f"the code of {node.name} could not be analysed completely"
            return Expected(
                f"Parameter `{one.name}` ({one.set_by.place}) gives the name to {node.name}, which does not use it. "
                "Let its code take the name from the parameter, or correct the value.",
                doubt=doubt,
            )
    return None


def _own(node: ConfiguredNode, role: Role) -> set[str]:
    return {
        one.endpoint.name
        for one in node.endpoints
        if one.endpoint.role is role and one.endpoint.name.startswith(f"{node.name}/") and not one.implicit
    }
