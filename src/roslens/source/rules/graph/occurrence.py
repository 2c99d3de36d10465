"""A finding of a rule of the graph."""

from __future__ import annotations

from collections.abc import Iterable

from roslens.model.configuration import ConfiguredNode, Proof
from roslens.model.finding import Finding, RuleInfo, Severity, fingerprint
from roslens.source.rules.by_package.left_behind import is_left_behind
from roslens.source.rules.graph.doubt import Doubt

TOOL = "graph"
_SURE = Doubt()


def occurrence(
    rule: RuleInfo,
    message: str,
    proof: Proof,
    *,
    entity: str,
    severity: Severity | None = None,
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
        severity: where doubt lowers it; what lies in a folder of what is no longer used is a note at most.
        context: tells it from other findings of the rule on the same entity in the same file, whatever the line.
        also: further entities for which it holds alike.
        doubt: why it may be none.
    """
    weight = rule.severity if severity is None else severity
    return Finding(
        rule.id,
        Severity.NOTE if is_left_behind(proof.path) else weight,
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
    )


def ids_of(nodes: Iterable[ConfiguredNode]) -> tuple[str, ...]:
    """Return the entities that nodes are, each once."""
    return tuple(dict.fromkeys(f"node:{node.name}" for node in nodes))
