"""Rule ``graph.parameter_undeclared``: a parameter that is set and that no code knows."""

from __future__ import annotations

import re
from collections.abc import Iterator

import msgspec

from roslens.model.configuration import Configuration, ConfiguredNode, ConfiguredParameter, Origin
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import visible
from roslens.source.rules.graph.doubt import weighed
from roslens.source.rules.graph.ends import is_unknown
from roslens.source.rules.graph.likeness import nearest_name
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.parameters.parameter_namespace import misplaced
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.parameter_undeclared",
    "Undeclared parameter",
    "A launch file or a parameter file sets a parameter that the node never declares (ROS 2) or reads (ROS 1). Nodes "
    "whose code is unknown, and parameters that every node has, are not reported. It is a warning if the node has a "
    "parameter of a similar name, otherwise a note: a library or plug-in may read it. Correct the name, or remove it. "
    "Parameters of one file with the same doubt are one finding; `others` in the JSON of `roslens graph --check` "
    "lists the rest.",
    Consequence.WRONG,
    Certainty.LIKELY,
    ("ros", "graph", "parameters", "launch"),
    "The value is ignored silently, and the node runs with its default.",
)
_OF_EVERY_NODE = frozenset({"use_sim_time", "start_type_description_service"})
_OF_LIBRARIES = frozenset({"image_transport", "tf_prefix"})
"""Parameters that libraries of a node read, in ROS 1 below its name."""
_FEW = 3
"""So many of one cause are reported one by one."""
_SHOWN = 3
_PREFIXES = ("qos_overrides.", "diagnostic_updater.")


def found(configuration: Configuration, _surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each parameter that is set and not known by the node it is set for."""
    ros1 = configuration.generation == "ros1"
    open_nodes = {one.node for one in configuration.unresolved if one.node}
    # What is set in the wrong namespace is reported by a rule of its own.
    elsewhere = {one.set.name for one in misplaced(configuration) if one.private}
    read = [one.name for node in configuration.nodes for one in node.parameters if one.access] if ros1 else []
    for node in configuration.nodes:
        if not _is_understood(node):
            continue
        process = _of_process(node, configuration)
        known = [one.name for each in process for one in each.parameters if one.access]
        spaces = _spaces(node) if ros1 else None
        unknown = [
            one
            for one in node.parameters
            if one.name not in elsewhere
            and (spaces is None or _above(one.name) in spaces)
            and _is_unknown(one, node, known, read, ros1=ros1)
        ]
        is_open = any(each.name in open_nodes or is_unknown(each) for each in process)
        for group in _groups(unknown, known, ros1=ros1, is_open=is_open):
            yield _told(node, group, known, ros1=ros1, is_open=is_open)


def _of_process(node: ConfiguredNode, configuration: Configuration) -> list[ConfiguredNode]:
    """Return a node with the others that its program makes: what a program is given holds for all of its nodes."""
    return [
        each
        for each in configuration.nodes
        if each is node
        or (
            (each.proof.place, each.executable) == (node.proof.place, node.executable)
            # The same file may be included once for each robot.
            and _above(each.name) == _above(node.name)
        )
    ]


def _groups(
    unknown: list[ConfiguredParameter], known: list[str], *, ros1: bool, is_open: bool
) -> Iterator[list[ConfiguredParameter]]:
    """Yield parameters of one cause together where they are many: those of one file, with one doubt."""
    if not known:
        # Where the code is not known to have any, all of them are one problem.
        yield from [unknown] if unknown else []
        return
    causes: dict[tuple[str, bool, bool], list[ConfiguredParameter]] = {}
    for one in unknown:
        path = one.set_by.path if one.set_by is not None else ""
        doubtful = is_open or _may_be_of_plugin(one, ros1=ros1)
        mistyped = not doubtful and bool(nearest_name(one.name, known))
        causes.setdefault((path, doubtful, mistyped), []).append(one)
    for (_path, _doubtful, mistyped), ones in causes.items():
        if mistyped or len(ones) <= _FEW:
            yield from ([one] for one in ones)
        else:
            yield ones


def _may_be_of_plugin(one: ConfiguredParameter, *, ros1: bool) -> bool:
    return "." in one.name and not ros1


def _spaces(node: ConfiguredNode) -> set[str] | None:
    """Return the namespaces of which servers of dynamic_reconfigure say all parameters; None of a node without any.

    Such nodes load plug-ins as a rule, which may read what is in other namespaces.
    """
    if not any(one.endpoint.type.startswith("dynamic_reconfigure/") for one in node.endpoints):
        return None
    return {_above(one.name) for one in node.parameters if one.access == "declared"}


def _above(name: str) -> str:
    return name.rpartition("/")[0]


def _is_unknown(
    one: ConfiguredParameter, node: ConfiguredNode, known: list[str], read: list[str], *, ros1: bool
) -> bool:
    if one.set_by is None or one.access or _is_of_every_node(one.name) or "*" in one.name:
        return False
    if one.value is None and any(name.startswith(f"{one.name}.") for name in known):
        # It may be a table of parameters, of which nobody knows what is in it.
        return False
    if not ros1 and one.name in known:
        return False
    if ros1 and (not one.name.startswith(f"{node.name}/") or _is_read(one.name, read)):
        return False
    return not any("*" in name and _fits(one.name, name) for name in known)


def _is_understood(node: ConfiguredNode) -> bool:
    """Whether its code says all parameters that it has."""
    return not is_unknown(node) and node.defined is not None and node.defined.origin is Origin.CODE and node.resolved


def _is_of_every_node(name: str) -> bool:
    return name in _OF_EVERY_NODE or name.startswith(_PREFIXES) or name.rpartition("/")[2] in _OF_LIBRARIES


def _is_read(name: str, read: list[str]) -> bool:
    """Whether some node reads it, or a map that it is in."""
    return any(name == one or name.startswith(one.rstrip("/") + "/") for one in read)


def _fits(name: str, pattern: str) -> bool:
    from fnmatch import fnmatchcase

    return fnmatchcase(name, pattern)


def _told(
    node: ConfiguredNode, group: list[ConfiguredParameter], known: list[str], *, ros1: bool, is_open: bool
) -> Finding:
    one, others = group[0], group[1:]
    proof = one.set_by
    assert proof is not None  # noqa: S101 - only parameters that are set are reported
    near = "" if others else nearest_name(one.name, known)
    fixed = "" if others or not ros1 else _fixed(one.name, node, known)
    near = near or fixed
    why = ""
    if is_open and not _differs_in_letters(near, one.name):
        why = f"the code of {node.name} could not be analysed completely"
    elif not known:
        why = f"no parameter of the code of {node.name} is known"
    elif _may_be_of_plugin(one, ros1=ros1):
        why = "a plug-in that the node loads may declare it"
    # A name that nothing resembles is as often read by a library or a plug-in as it is wrong (docs/accuracy.md).
    certainty, doubt = weighed(RULE.certainty if near else Certainty.HEURISTIC, (proof,), node.conditions, more=why)
    verb = "reads" if ros1 else "declares"
    advice = f"Did you mean {visible(near)}?" if near else f"Correct the name or remove it; {_knows(known)}."
    if fixed and ros1:
        read = f"Its code reads {visible(fixed)}, under a name that it no longer has"
        advice = f"{read}: read it as a private parameter (`~`)."
    where = f" ({node.defined.place})" if node.defined is not None else ""
    message = (
        f"parameter{'s' if others else ''} {_named(group)} set for {node.name}{where}, which never {verb} "
        f"{_it(known, others)}. {advice}"
    )
    entity = f"parameter:{node.name}:{one.name}"
    found = occurrence(RULE, message, proof, entity=entity, certainty=certainty, context=proof.path, doubt=doubt)
    same = tuple(f"{other.name} ({other.set_by.place})" for other in others if other.set_by is not None)
    return msgspec.structs.replace(found, others=same)


def _fixed(name: str, node: ConfiguredNode, known: list[str]) -> str:
    """Return the absolute name with another node in it under which the code reads a private parameter of a node.

    Code that writes its own name into the name of a parameter reads nothing where the node has another name.
    """
    private = name.removeprefix(node.name)
    others = [
        one
        for one in known
        if one.endswith(private) and one.count("/") == 1 + private.count("/") and not one.startswith(f"{node.name}/")
    ]
    return others[0] if len(others) == 1 and private.startswith("/") else ""


def _differs_in_letters(near: str, name: str) -> bool:
    """Whether a name that is nearly the same is there, and not one that only counts on: that outweighs unknown code."""
    return bool(near) and re.sub(r"\d", "", near) != re.sub(r"\d", "", name)


def _named(group: list[ConfiguredParameter]) -> str:
    if len(group) == 1:
        return f"{visible(group[0].name)} is"
    shown, rest = [f"`{one.name}`" for one in group[:_SHOWN]], len(group) - _SHOWN
    last = f"{rest} more" if rest > 0 else shown.pop()
    return f"{', '.join(shown)} and {last} are"


def _it(known: list[str], others: list[ConfiguredParameter]) -> str:
    if not others:
        return "it"
    return "them" if known else "any"


def _knows(known: list[str]) -> str:
    return f"it knows {', '.join(sorted(known)[:5])}{' …' if len(known) > 5 else ''}" if known else "it knows none"
