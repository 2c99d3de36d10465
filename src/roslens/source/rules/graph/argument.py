"""Rule ``graph.argument``: an argument of a launch file that must be given and is not, or has no valid value."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.model.configuration import Configuration, ConfiguredArgument
from roslens.model.finding import Finding
from roslens.model.weight.consequence import Certainty, Consequence
from roslens.model.words.shortened import visible
from roslens.source.rules.graph.ends import is_launched
from roslens.source.rules.graph.likeness import nearest_name
from roslens.source.rules.graph.occurrence import graph_rule, occurrence
from roslens.source.rules.graph.surroundings import Surroundings

RULE = graph_rule(
    "graph.argument",
    "Missing or invalid launch argument",
    "A launch file that is started with certain arguments, by `roslens.toml` or on the command line, is missing one "
    "that it declares without a default, is given one that it does not declare, or one whose value is not among its "
    "choices. Without such a start a required argument is not reported: it is meant to be given by the caller.",
    Consequence.STOPS_START,
    Certainty.PROVEN,
    ("ros", "graph", "launch"),
    "Launching fails if an argument is missing; an undeclared one is ignored silently.",
)


def found(configuration: Configuration, surroundings: Surroundings) -> Iterator[Finding]:
    """Yield a finding for each argument that is missing, of no use, or of no valid value."""
    given = surroundings.given
    declared = {one.name: one for one in configuration.arguments}
    for name, one in sorted(declared.items()):
        near = nearest_name(name, [other for other in given if other not in declared])
        if one.default is None and name not in given:
            if surroundings.started:
                yield _missing(one, near)
        elif one.choices and name in given and given[name] not in one.choices:
            message = (
                f"argument `{name}` is given as `{given[name]}`; {one.proof.place} allows {', '.join(one.choices)}."
            )
            yield occurrence(RULE, message, one.proof, entity=_entity(one), context=name)
    if not is_launched(configuration) or not declared:
        return
    first = min(configuration.arguments, key=lambda one: one.proof)
    for name in sorted(set(given) - set(declared)):
        near = nearest_name(name, list(declared))
        advice = f"Did you mean {visible(near)}?" if near else f"It declares {', '.join(sorted(declared))}."
        message = f"argument `{name}` is given, but {first.proof.path} declares none of that name. {advice}"
        yield occurrence(RULE, message, first.proof, entity=_entity(first), certainty=Certainty.LIKELY, context=name)


def _missing(one: ConfiguredArgument, near: str) -> Finding:
    advice = f"`{near}` is given instead." if near else f"Give `{one.name}:=…` or declare a default."
    means = f" ({one.description})" if one.description else ""
    message = f"argument `{one.name}`{means} must be given: {one.proof.place} declares it without a default. {advice}"
    return occurrence(RULE, message, one.proof, entity=_entity(one), context=one.name)


def _entity(one: ConfiguredArgument) -> str:
    return f"launch_file:{one.proof.path}"
