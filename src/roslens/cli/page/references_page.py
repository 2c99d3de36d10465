"""The references of a watch as its page shows them: what each constraint is about, and a draft for the rest."""

from __future__ import annotations

import json
import statistics
from collections import Counter
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from roslens.cli.page.half_lines import encodable
from roslens.cli.page.watch_graph import PLUMBING
from roslens.dashboard.live.board import ConstraintRow, Proposal, References, Twice
from roslens.judge.ranges.amount import amount_text
from roslens.judge.reference.constraint_words import expected_words, subject_words
from roslens.judge.reference.merge_references import constraints_of
from roslens.judge.reference.unmatched import Subject, subjects_of, unmatched
from roslens.live.drafting.draft_lines import LESS, MORE, rounded
from roslens.live.system.shown_rows import is_shown
from roslens.model.entity import EntityId, EntityKind
from roslens.model.verdict import State, Verdict

if TYPE_CHECKING:
    from roslens.judge.reference.expectation import Reference
    from roslens.live.system.tree import SystemView
    from roslens.model.graph import Graph
    from roslens.store.past.recall import Recall
    from roslens.store.past.stretch import Piece

MOST_NAMED = 5
MOST_PROPOSED = 200
STRETCH_S = 900.0
LEAST_S = 30
"""Seconds of which something must be known before a rate is proposed."""
_MOST_TWICE = 200


def references_of(
    reference: Reference, view: SystemView, standing: Sequence[Verdict], graph: Graph, recall: Recall | None, now: float
) -> References:
    """Return what is expected, held against what is there."""
    by_constraint: dict[str, list[Verdict]] = {}
    for one in standing:
        by_constraint.setdefault(one.expectation, []).append(one)
    # Without nodes it is a recording of topics alone.
    kinds = tuple(EntityKind) if graph.nodes else (EntityKind.TOPIC,)
    there = {*subjects_of(graph), *_sampled(view)}
    advice = {one.constraint.details.id: one.advice for one in unmatched(reference, there, kinds)}
    rows = []
    for constraint in constraints_of(reference):
        about = by_constraint.get(constraint.details.id, [])
        # What is expected by its whole name is judged as absent where it is not there.
        entities = (
            [] if constraint.details.id in advice else sorted({encodable(str(verdict.entity)) for verdict in about})
        )
        states = Counter(verdict.state.value for verdict in about)
        rows.append(
            ConstraintRow(
                constraint.details.id,
                encodable(subject_words(constraint)),
                encodable(expected_words(constraint)),
                constraint.details.severity.value,
                encodable(constraint.details.where),
                len(entities),
                tuple(entities[:MOST_NAMED]),
                dict(sorted(states.items())),
                encodable(advice.get(constraint.details.id, "")),
            )
        )
    rows.sort(key=lambda one: (bool(one.count), not _deviates(one)))
    proposals = list(_proposals(view, recall, now)) if recall is not None else []
    left_out = max(len(proposals) - MOST_PROPOSED, 0)
    return References(
        tuple(map(encodable, reference.documents)),
        tuple(rows),
        tuple(_twice(standing))[:_MOST_TWICE],
        tuple(proposals[:MOST_PROPOSED]),
        left_out,
    )


def _deviates(one: ConstraintRow) -> bool:
    return any(State(state).bad for state in one.states)


def _sampled(view: SystemView) -> Iterable[Subject]:
    """Yield the hosts, nodes and processes of which values are known, whether or not a graph has them."""
    waiting = [(part, part.name if part.kind == "host" else "") for part in view.children]
    while waiting:
        part, host = waiting.pop()
        waiting += [(child, host) for child in part.children]
        if part.values and part.kind in ("host", "node", "process"):
            entity = EntityId.parse(part.id)
            yield Subject(entity.kind, entity.name, host)


def document_of(proposals: Iterable[Proposal], accepted: Iterable[str], name: str) -> str:
    """Return the accepted proposals as a reference; those that are not proposed any more are left out."""
    wanted = set(accepted)
    lines = [f"  {one.line}  # {one.evidence}" for one in proposals if one.key in wanted]
    head = ["kind: reference", f"name: {json.dumps(name)}", "defaults: {for: 2 s, margin: 5 %}"]
    return "\n".join([*head, "constraints:" if lines else "constraints: []", *lines, ""])


def _twice(standing: Iterable[Verdict]) -> Iterable[Twice]:
    found: dict[tuple[str, str], list[tuple[str, str]]] = {}
    for one in standing:
        key = encodable(str(one.entity)), one.quantity
        found.setdefault(key, []).append((one.expectation, encodable(one.range)))
    for (entity, quantity), constraints in sorted(found.items()):
        if len(constraints) > 1:
            yield Twice(entity, quantity, tuple(sorted(constraints)))


def _proposals(view: SystemView, recall: Recall, now: float) -> Iterable[Proposal]:
    seen: set[str] = set()
    waiting = list(view.children)
    while waiting:
        part = waiting.pop(0)
        waiting += part.children
        if part.id in seen or part.state is not None or not is_shown(part):
            continue
        seen.add(part.id)
        if part.kind != "topic" or part.name in PLUMBING:
            continue
        pieces = recall.stretches(encodable(part.id), now - STRETCH_S, now, int(STRETCH_S), ("rate",)).get("rate", ())
        if (found := _rate(part.name, pieces)) is not None:
            yield found


def _rate(topic: str, pieces: Sequence[Piece]) -> Proposal | None:
    values = [one.mean for one in pieces if one.mean > 0]
    if sum(one.seconds for one in pieces) < LEAST_S or len(values) < len(pieces):
        return None
    typical = statistics.median(values)
    low, high = rounded(LESS * typical, up=False), rounded(MORE * typical, up=True)
    # What varies as much comes with events rather than at a rate.
    if min(values) < low or max(values) > high:
        return None
    name = json.dumps(encodable(topic))
    line = f'- {{topic: {name}, rate: "{low:g}..{high:g} Hz"}}'
    seconds = sum(one.seconds for one in pieces)
    least, most = (amount_text(float(f"{one:.3g}"), "Hz") for one in (min(values), max(values)))
    evidence = f"observed {least if least == most else f'{least} to {most}'} during {seconds} s"
    return Proposal(f"topic:{encodable(topic)}", line, evidence)
