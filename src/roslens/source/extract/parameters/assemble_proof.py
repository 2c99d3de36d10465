"""Evidence of facts in the words of a configuration."""

from __future__ import annotations

from roslens.model.configuration import Origin, Proof
from roslens.source.extract.facts.node_facts import Evidence


def proof_of(evidence: Evidence, origin: Origin = Origin.CODE) -> Proof:
    """Return evidence as a proof."""
    how = "" if evidence.how == "written" else evidence.how
    return Proof(evidence.path, evidence.line, evidence.column, how, evidence.sure.value, origin)


def launch_proof(evidence: Evidence) -> Proof:
    """Return evidence in a launch file, or a file of parameters, as a proof."""
    return proof_of(evidence, Origin.LAUNCH)
