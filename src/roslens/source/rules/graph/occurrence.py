"""A finding of a rule of the graph."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.model.configuration import ConfiguredNode, Proof
from roslens.model.finding import Finding, RuleInfo, fingerprint
from roslens.model.weight.consequence import Certainty, Consequence, severity_of
from roslens.source.rules.by_package.left_behind import is_left_behind
from roslens.source.rules.field.precision import is_confirmed, precision_of
from roslens.source.rules.graph.doubt import Doubt

TOOL = "graph"
_SURE = Doubt()


def graph_rule(
    identity: str,
    title: str,
    finds: str,
    consequence: Consequence,
    certainty: Certainty,
    tags: tuple[str, ...],
    why: str,
    *,
    url: str = "",
) -> RuleInfo:
    """Return a rule of the graph.

    Args:
        identity: its id.
        title: a heading of a few words.
        finds: what is reported, and what to do instead, in sentences.
        consequence: what follows if a finding is left as it is.
        certainty: how certain that is where all that a finding rests on is certain.
        tags: what readers filter by.
        why: why it matters on a robot.
        url: of a page on it.
    """
    unproven = certainty is Certainty.HEURISTIC and not is_confirmed(identity)
    return RuleInfo(
        identity,
        title,
        finds,
        severity_of(consequence, certainty, unproven=unproven),
        tags,
        why,
        tool=TOOL,
        scope="configuration",
        url=url,
        precision=precision_of(identity),
        consequence=consequence,
        certainty=certainty,
        unproven=unproven,
    )


def occurrence(
    rule: RuleInfo,
    message: str,
    proof: Proof,
    *,
    entity: str,
    certainty: Certainty | None = None,
    consequence: Consequence | None = None,
    context: str = "",
    also: tuple[str, ...] = (),
    doubt: Doubt = _SURE,
) -> Finding:
    """Return an occurrence of a rule at the place that shows it.

    Args:
        rule: that is broken.
        message: what was found, where, what was expected, what to do; why it is in doubt stands behind it.
        proof: of what is found fault with.
        entity: text form of its id.
        certainty: where it differs from the rule's, as where it rests on what is in doubt. What lies in a folder of
            what is no longer used is heuristic. A finding that is heuristic where its rule is not is a note.
        consequence: where it differs from the rule's.
        context: tells it from other findings of the rule on the same entity in the same file, whatever the line.
        also: further entities for which it holds alike.
        doubt: why it may be none.
    """
    of_all, of_rule = rule.weight
    what = consequence or of_all
    own = Certainty.HEURISTIC if is_left_behind(proof.path) else certainty or of_rule
    unproven = rule.unproven or own.rank < of_rule.rank
    return Finding(
        rule.id,
        severity_of(what, own, unproven=unproven),
        f"{message}{doubt}",
        proof.path,
        proof.line,
        proof.column,
        entity=entity,
        tags=rule.tags,
        tool=TOOL,
        fingerprint=fingerprint(rule.id, entity, f"{proof.path} {context}"),
        also=also,
        doubts=doubt.reasons,
        consequence=what,
        certainty=own,
    )


def ids_of(nodes: Iterable[ConfiguredNode]) -> tuple[str, ...]:
    """Return the entities that nodes are, each once."""
    return tuple(dict.fromkeys(f"node:{node.name}" for node in nodes))
