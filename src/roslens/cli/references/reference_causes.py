"""What was wrong with an entity in a recording, and the way from there to its first cause."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from roslens.judge.reference.expectation import Reference
    from roslens.model.entity import EntityId
    from roslens.model.verdict import Verdict


def found_wrong(reference: Reference, bag: Sequence[Path], entity: EntityId) -> tuple[float, list[Verdict]]:
    """Return when a recording begins, and the bad verdicts about an entity with the causes they had, by time.

    Raises:
        UsageError: there is no recording.
    """
    from roslens.live.adapters.bag.open_bag import open_bag
    from roslens.live.replay.replay import replay

    opened = open_bag(list(bag))
    found: list[Verdict] = []
    latest: dict[str, tuple[str, bool]] = {}

    def take(step: Any) -> None:
        for one in (*step.changes, *step.causes):
            if one.entity == entity:
                said = (one.cause, one.state.bad)
                if one.state.bad and latest.get(one.expectation) != said:
                    found.append(one)
                latest[one.expectation] = said

    replay(opened, reference, report=take)
    return opened.start, found


def lines(start: float, found: Sequence[Verdict]) -> list[str]:
    """Return what was wrong, when, and why."""
    from roslens.live.explain.links import links_text

    rows = []
    for one in found:
        leads = f" → {one.leads_to}" if one.leads_to else ""
        rows.append(f"  {one.time - start:9.2f} s  {one.expectation} is {one.state.value}: {one.evidence}{leads}")
        if one.why:
            rows.append(f"               {links_text(one.entity, one.why)}")
        else:
            rows.append("               it is a first cause")
    return rows


def rows(start: float, found: Sequence[Verdict]) -> list[dict[str, Any]]:
    """Return the same for programs."""
    import msgspec

    return [
        {**msgspec.to_builtins(one), "entity": str(one.entity), "at": one.time - start, "first_cause": not one.cause}
        for one in found
    ]
