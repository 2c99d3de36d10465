"""The small graph of what is wrong and why: first causes at the left, what follows from them at the right.

Pure: ways from faults to their causes in, boxes and lines with places out.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence

import msgspec

WIDE, HIGH = 200.0, 34.0
"""Of a box, in pixels."""
BETWEEN, APART = 190.0, 26.0
"""Between columns, where what shows a link is written, and between boxes of a column."""
_BEND = 34.0
"""So much of that room, beside the cause, is where lines change their height; words stand in the rest."""
MARGIN = 8.0
MOST_BOXES = 40
"""More would be no small graph; what does not fit is said."""


class CauseBox(msgspec.Struct, frozen=True):
    """An entity; ``x`` and ``y`` are the upper left corner, ``first`` is whether it is a first cause."""

    entity: str
    name: str
    kind: str
    state: str
    first: bool
    x: float
    y: float


class CauseLine(msgspec.Struct, frozen=True):
    """That one box explains another, both by their place in the list of boxes.

    Attributes:
        cause: nearer to the first cause.
        effect: which is explained.
        relation: what the effect has to do with it: ``is published by``.
        evidence: what shows it; empty where it only hands on what it does not get.
        path: of the line, as SVG has it.
        x: middle of the words.
        y: of their first line.
    """

    cause: int
    effect: int
    relation: str
    evidence: str
    path: str
    x: float
    y: float


class CausePicture(msgspec.Struct, frozen=True, omit_defaults=True):
    """The graph; ``left_out`` describes what is not in it."""

    width: float = 0.0
    height: float = 0.0
    boxes: tuple[CauseBox, ...] = ()
    lines: tuple[CauseLine, ...] = ()
    left_out: str = ""


class Step(msgspec.Struct, frozen=True):
    """One link of a way: ``effect`` is explained by ``cause``, both text forms of ids."""

    effect: str
    cause: str
    relation: str
    evidence: str


def cause_picture(
    ways: Iterable[Sequence[Step]], states: Mapping[str, str], alerts: Collection[str] = ()
) -> CausePicture:
    """Return the graph of ways from faults to first causes, each from the fault on.

    Args:
        ways: of faults that another explains; what several share is drawn once.
        states: worst state of each entity that is judged.
        alerts: entities that are bad and that nothing explains, even where they stand on the way to a graver cause.
    """
    steps: dict[tuple[str, str], Step] = {}
    left_out = 0
    boxes: set[str] = set()
    for way in ways:
        fresh = {end for step in way for end in (step.effect, step.cause)} - boxes
        if len(boxes) + len(fresh) > MOST_BOXES:
            left_out += 1
            continue
        boxes |= fresh
        for step in way:
            known = steps.get((step.effect, step.cause))
            if known is None or (step.evidence and not known.evidence):
                steps[step.effect, step.cause] = step
    if not steps:
        return CausePicture()
    levels = _levels(steps)
    placed = _placed(levels)
    order = sorted(levels, key=lambda one: (levels[one], placed[one]))
    numbers = {entity: number for number, entity in enumerate(order)}
    explained = {effect for effect, _ in steps}
    drawn = tuple(
        CauseBox(
            entity=entity, name=entity.partition(":")[2], kind=entity.partition(":")[0],
            state=states.get(entity, "unjudged"), first=entity not in explained or entity in alerts,
            x=MARGIN + levels[entity] * (WIDE + BETWEEN), y=MARGIN + placed[entity] * (HIGH + APART),
        )
        for entity in order
    )  # fmt: skip
    lines = tuple(_line(numbers, drawn, step) for _, step in sorted(steps.items()))
    return CausePicture(
        width=max(one.x for one in drawn) + WIDE + MARGIN,
        height=max(one.y for one in drawn) + HIGH + MARGIN,
        boxes=drawn,
        lines=lines,
        left_out=f"{left_out} more faults that follow from others" if left_out else "",
    )


def _levels(steps: Mapping[tuple[str, str], Step]) -> dict[str, int]:
    """Return how many links each entity is from the first cause, the longest way; a circle counts each once."""
    causes: dict[str, list[str]] = {}
    for effect, cause in sorted(steps):
        causes.setdefault(effect, []).append(cause)
        causes.setdefault(cause, [])
    levels: dict[str, int] = {}

    def level(entity: str, above: frozenset[str]) -> int:
        if entity not in levels:
            nearer = [level(one, above | {entity}) for one in causes[entity] if one not in above and one != entity]
            found = 1 + max(nearer) if nearer else 0
            if above:
                return levels.setdefault(entity, found)
            levels[entity] = found
        return levels[entity]

    for entity in sorted(causes):
        level(entity, frozenset())
    return levels


def _placed(levels: Mapping[str, int]) -> dict[str, int]:
    placed: dict[str, int] = {}
    rows: dict[int, int] = {}
    for entity in sorted(levels, key=lambda one: (levels[one], one)):
        column = levels[entity]
        placed[entity] = rows.get(column, 0)
        rows[column] = placed[entity] + 1
    return placed


def _line(numbers: Mapping[str, int], boxes: Sequence[CauseBox], step: Step) -> CauseLine:
    cause, effect = boxes[numbers[step.cause]], boxes[numbers[step.effect]]
    left, right = cause.x + WIDE, effect.x
    top, bottom = cause.y + HIGH / 2, effect.y + HIGH / 2
    bent = right - BETWEEN + _BEND
    middle = (left + bent) / 2
    path = f"M{left:g} {top:g}C{middle:g} {top:g} {middle:g} {bottom:g} {bent:g} {bottom:g}H{right:g}"
    # Words stand at the effect, whose lines come from one cause as a rule.
    return CauseLine(
        cause=numbers[step.cause], effect=numbers[step.effect], relation=step.relation, evidence=step.evidence,
        path=path, x=right - (BETWEEN - _BEND) / 2, y=bottom - 5,
    )  # fmt: skip
