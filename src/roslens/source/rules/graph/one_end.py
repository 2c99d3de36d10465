"""Rule ``graph.one_end``: a topic, service or action that only one side uses."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, Origin
from roslens.model.finding import Finding
from roslens.model.graphs.end import OTHER, VERB, End
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import shortened
from roslens.source.rules.graph.doubt import weighed, weighed_apart
from roslens.source.rules.graph.ends import by_name, ends, is_launched, listed
from roslens.source.rules.graph.expected_end import WAITING, Expected, View, expected, types_fit, view_of
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.one_end",
    "Endpoint without a counterpart",
    "A topic, service or action is used by one side only. Most such names are the interface of a node to other "
    "programs, so this is a note. If the other end is expected, the message states why: another node has nearly the "
    "same name, or the same one in another namespace, with the same type, and it is also used by one side only; the "
    "name is below that of a node of the configuration that has no such endpoint; or a parameter passes it to a node "
    "that does not use it. Topics with subscribers only are listed, those with publishers only if their type is "
    "defined in the workspace. In a configuration that `roslens.toml` declares to be the whole system (`whole = "
    "true`), a subscription without a publisher and a client without a server are warnings, and so is one that a "
    "remapping to a global name takes out of the namespace in which the other end is. Names whose other end is "
    "usually outside the workspace are not reported; `external` in `[options.graph]` lists them.",
    Consequence.MAY_BE_WRONG,
    Certainty.HEURISTIC,
    ("ros", "graph", "names", "connectivity"),
    "A name that is mistyped, remapped incorrectly or in the wrong namespace connects nothing, and no node reports "
    "it: a subscription waits for ever.",
)
_PARTS_OF_ACTION = frozenset({"goal", "cancel", "status", "result", "feedback"})


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each name with one end only; two of them that seem to mean each other are one finding."""
    named = by_name(ends(configuration))
    lonely = {
        key: of_name
        for key, of_name in named.items()
        if len({end.role for end in of_name}) == 1 and not surroundings.is_external(key[1])
    }
    launched = is_launched(configuration)
    # Who listens to a type of the workspace is in the workspace, as a rule.
    own = {one.name for one in surroundings.packages}
    view = view_of(configuration, named, lonely)
    paired: set[tuple[str, str]] = set()
    # Those that wait come first: a publisher without subscribers is seldom the mistake.
    for key, of_name in sorted(lonely.items(), key=lambda item: item[1][0].role not in WAITING):
        if key in paired or _is_part_of_action(key, view) or key in view.implicit or _is_known_to_be_open(of_name):
            continue
        why = expected(of_name, view)
        if why is not None and why.name:
            paired.add((key[0], why.name))
        open_ended = of_name[0].role not in WAITING and of_name[0].type.partition("/")[0] not in own
        if why is not None or (launched and (surroundings.whole or not open_ended)):
            yield _told(key, of_name, why, view, surroundings)


def _is_part_of_action(key: tuple[str, str], view: View) -> bool:
    """Whether it is one of the five topics of an action of ROS 1 that is known as such."""
    name, _, last = key[1].rpartition("/")
    return last in _PARTS_OF_ACTION and ("action", name) in view.by_name


def _is_known_to_be_open(of_name: list[End]) -> bool:
    """Whether only nodes from outside of the workspace use it: they offer more than one system needs.

    A name that they wait on is meant where the launch file chose it, by a parameter or a remapping.
    """
    return all(
        end.one.proof.origin is Origin.CATALOGUE and not (end.role in WAITING and _is_chosen(end)) for end in of_name
    )


def _is_chosen(end: End) -> bool:
    return end.one.remapped is not None or (end.one.given != end.name and end.one.by_parameter)


def _told(
    key: tuple[str, str], of_name: list[End], why: Expected | None, view: View, surroundings: Surroundings
) -> Finding:
    kind, name = key
    end = of_name[0]
    waits = end.role in WAITING
    usual = Certainty.LIKELY if waits and (surroundings.whole or _leaves_its_namespace(end, why)) else RULE.certainty
    certainty, doubt = weighed(
        usual,
        (end.one.proof,),
        end.conditions,
        # That the other end is expected says more than that somebody unknown might be there.
        more=_missing(view) or (_more_doubt(end, view) if why is None else why.doubt),
    )
    said = listed([f"{one.label} {VERB[one.role]}" for one in of_name])
    missing = ("publisher", "subscriber") if kind == "topic" else ("server", "client")
    message = f"{said} the {kind} {name}, which has no {missing[0 if waits else 1]}."
    if why is not None:
        message += f" {why.words}"
    elif waits:
        message += " Start the node that provides it, or correct the name."
    if not doubt and end.one.given and end.one.given != name:
        message += f" It is given as `{end.one.given}`."
    if not surroundings.together:
        certainty, doubt = weighed_apart(doubt)
    return occurrence(
        RULE, message, end.where, entity=end.entity, certainty=certainty, context=end.role.value, doubt=doubt
    )


def _leaves_its_namespace(end: End, why: Expected | None) -> bool:
    """Return whether a remapping leads out of the namespace of a node, in which the other end of the name waits.

    A leading slash leaves the namespace that a group or a launch file pushes.
    """
    space = end.node.name.rpartition("/")[0]
    moved = end.one.remapped is not None and why is not None and why.name == f"{space}{end.name}"
    return bool(space) and moved


def _missing(view: View) -> str:
    """Return in words what of the configuration could not be followed; the other end may be there."""
    if not view.missing:
        return ""
    places = listed([f"`{shortened(one.text, 60)}` ({one.proof.place})" for one in view.missing])
    return f"the configuration is incomplete: the nodes that {places} starts are unknown"


def _more_doubt(end: End, view: View) -> str:
    """Return in words what may be the other end without being known."""
    if view.unknown:
        names = listed([node.name for node in view.unknown])
        return f"the endpoints of {names} are unknown"
    wanted = OTHER[end.role]
    open_ends = [one for one in view.unresolved if one.role is wanted and types_fit(end, one)]
    if open_ends:
        return f"the name is unknown for {listed([one.label for one in open_ends])}"
    return ""
