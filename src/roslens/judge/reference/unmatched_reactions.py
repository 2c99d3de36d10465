"""Reactions about what is not in a graph: conditions that nothing can fulfil, and targets that do not exist."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from roslens.judge.reference.condition_contradiction import statements
from roslens.judge.reference.constraint_words import selector_words
from roslens.judge.reference.expectation import Selector
from roslens.judge.reference.pattern_index import CompiledSelector
from roslens.judge.reference.unmatched import Subject
from roslens.model.acting.condition import Stated
from roslens.model.acting.reaction import Reaction
from roslens.model.entity import EntityKind
from roslens.model.errors import DocumentError
from roslens.plugins.nearest import nearest_few


def unmatched_statements(
    reactions: Iterable[Reaction], subjects: Sequence[Subject], kinds: Collection[EntityKind] = tuple(EntityKind)
) -> Iterator[str]:
    """Yield the statements of conditions that are about nothing, in words, with their places.

    Args:
        reactions: whose conditions are looked at.
        subjects: everything that is there.
        kinds: of entities that could be seen at all.
    """
    reported = set()
    for reaction in reactions:
        for stated in _all_statements(reaction):
            selector = stated.selector
            if selector.kind not in kinds or stated.place in reported or _is_matched(selector, subjects):
                continue
            reported.add(stated.place)
            text = f"{stated.place}: {reaction.name} matches nothing: no {selector_words(selector)} exists"
            yield text + _advice(selector.name, selector.kind, subjects)


def _all_statements(reaction: Reaction) -> Iterator[Stated]:
    for condition in (reaction.when, reaction.only_while, reaction.unless):
        if condition is not None:
            yield from statements(condition)


def _is_matched(selector: Selector, subjects: Iterable[Subject]) -> bool:
    compiled = CompiledSelector(selector)
    return any(
        one.kind is selector.kind and compiled.matches(one.name, (one.host, one.type, one.publisher, one.subscriber))
        for one in subjects
    )


def refuse_unknown_targets(reactions: Iterable[Reaction], subjects: Sequence[Subject]) -> None:
    """Refuse actions on entities that are not there.

    Raises:
        DocumentError: one is not, with the place of the action and what might have been meant.
    """
    there = {(one.kind, one.name) for one in subjects}
    for reaction in reactions:
        for step in reaction.steps:
            target = step.action.target
            if target is None or "{" in target.name or step.action.kind == "start":
                continue
            if (target.kind, target.name) not in there:
                raise DocumentError(
                    f"`{step.action.kind}` of {target.name!r}",
                    where=step.action.place,
                    expected=f"a {target.kind.value} that is there",
                    advice=_advice(target.name, target.kind, subjects).removeprefix(". "),
                )


def _advice(name: str, kind: EntityKind, subjects: Sequence[Subject]) -> str:
    near = nearest_few(name, sorted({one.name for one in subjects if one.kind is kind}))
    return f". Did you mean {' or '.join(map(repr, near))}?" if near else ""
