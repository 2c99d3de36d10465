"""Constraints that are about nothing that is there: a typing error mostly, or a part that was never started."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Sequence

import msgspec

from roslens.judge.patterns.pattern import Pattern
from roslens.judge.reference.constraint_words import selector_words
from roslens.judge.reference.expectation import AgeChain, FieldCheck, Presence, Reference, Selector
from roslens.judge.reference.merge_references import constraints_of
from roslens.judge.reference.pattern_index import PatternIndex
from roslens.judge.reference.reference_document import ReferenceConstraint
from roslens.model.entity import EntityKind
from roslens.model.graph import Graph, Role
from roslens.plugins.nearest import nearest_few


class Subject(msgspec.Struct, frozen=True, order=True):
    """An entity with what selectors ask for; what is unknown is empty."""

    kind: EntityKind
    name: str
    host: str = ""
    type: str = ""
    publisher: str = ""
    subscriber: str = ""


MOST_NAMED = 3
MOST_ADVISED = 50
"""Constraints for which names are looked up that might have been meant."""


class Unmatched(msgspec.Struct, frozen=True):
    """A constraint, the part of it that matches nothing, and what might have been meant."""

    constraint: ReferenceConstraint
    selector: Selector
    advice: str = ""

    def __str__(self) -> str:
        """Return it in the message form."""
        details = self.constraint.details
        text = f"{details.where}: {details.id} matches nothing: no {selector_words(self.selector)} exists"
        return f"{text}. {self.advice}" if self.advice else text


def unmatched(
    reference: Reference, subjects: Iterable[Subject], kinds: Collection[EntityKind] = tuple(EntityKind)
) -> list[Unmatched]:
    """Return the constraints that match nothing, sorted by id.

    That something must always be there, or never, is about what is not there too, and so never among them.

    Args:
        reference: what is expected.
        subjects: everything that has been seen.
        kinds: of entities that can be seen at all; a recording, for one, knows of no host.
    """
    asked = [(selector, constraint) for constraint in constraints_of(reference) for selector in _selectors(constraint)]
    index = PatternIndex((selector, number) for number, (selector, _) in enumerate(asked))
    matched: set[int] = set()
    there: dict[EntityKind, dict[str, list[Subject]]] = defaultdict(dict)
    for subject in subjects:
        there[subject.kind].setdefault(subject.name, []).append(subject)
        matched.update(_find(index, subject))
    missing = [pair for number, pair in enumerate(asked) if number not in matched and pair[0].kind in kinds]
    return [
        Unmatched(constraint, selector, _advice(selector, there[selector.kind]) if number < MOST_ADVISED else "")
        for number, (selector, constraint) in enumerate(missing)
    ]


def subjects_of(graph: Graph) -> tuple[Subject, ...]:
    """Return everything that selectors can be about in a graph, sorted."""
    found = {Subject(EntityKind.HOST, host) for host in graph.hosts}
    found |= {Subject(EntityKind.PROCESS, f"{process.host}/{process.pid}", process.host) for process in graph.processes}
    hosts = {node.name: node.host for node in graph.nodes}
    found |= {Subject(EntityKind.NODE, name, host) for name, host in hosts.items()}
    found |= {
        Subject(EntityKind.PARAMETER, f"{node}/{name}", hosts.get(node, ""))
        for node, values in graph.parameters.items()
        for name in values
    }
    ends: dict[str, tuple[list[tuple[str, str]], list[str]]] = defaultdict(lambda: ([], []))
    for endpoint in graph.endpoints:
        if endpoint.role is Role.PUBLISHER:
            ends[endpoint.name][0].append((endpoint.node, endpoint.type))
            found.add(Subject(EntityKind.TOPIC, endpoint.name, type=endpoint.type, publisher=endpoint.node))
        elif endpoint.role is Role.SUBSCRIPTION:
            ends[endpoint.name][1].append(endpoint.node)
            found.add(Subject(EntityKind.TOPIC, endpoint.name, type=endpoint.type))
        elif endpoint.role is Role.SERVICE_SERVER:
            found.add(Subject(EntityKind.SERVICE, endpoint.name, hosts.get(endpoint.node, ""), endpoint.type))
    for topic, (publishers, subscribers) in ends.items():
        found |= {
            Subject(EntityKind.CONNECTION, topic, hosts.get(publisher, ""), type_, publisher, subscriber)
            for publisher, type_ in publishers
            for subscriber in subscribers
        }
    return tuple(sorted(found))


def _find(index: PatternIndex[int], subject: Subject) -> Sequence[int]:
    return index.find(
        subject.kind,
        subject.name,
        host=subject.host,
        type=subject.type,
        publisher=subject.publisher,
        subscriber=subject.subscriber,
    )


def _selectors(constraint: ReferenceConstraint) -> tuple[Selector, ...]:
    """Return what a constraint needs to be there to be about something."""
    if isinstance(constraint, Presence):
        return (constraint.condition,) if constraint.condition is not None else ()
    if isinstance(constraint, FieldCheck):
        named = {part.topic for part in (constraint.condition, constraint.other) if part is not None and part.topic}
        others = sorted(named - {Pattern.parse(constraint.topic).literal})
        return (constraint.selector, *(Selector(EntityKind.TOPIC, _escaped(topic)) for topic in others))
    if isinstance(constraint, AgeChain):
        return tuple(Selector(EntityKind.TOPIC, _escaped(topic)) for topic in constraint.topics)
    return (constraint.selector,)


def _escaped(name: str) -> str:
    return "".join(f"\\{char}" if char in "*?{},\\" else char for char in name)


def _advice(selector: Selector, there: dict[str, list[Subject]]) -> str:
    """Return what might have been meant: another name, or the same with another type or other ends."""
    pattern = Pattern.parse(selector.name)
    without = [Pattern.parse(text) for text in selector.without]
    named = [name for name in there if pattern.matches(name) and not any(one.matches(name) for one in without)]
    if named:
        first = min(named)
        return f"{first} is there{_otherwise(selector, there[first])}"
    near = nearest_few(selector.name, there)
    return f"Did you mean {' or '.join(map(repr, near))}?" if near else ""


def _otherwise(selector: Selector, subjects: Sequence[Subject]) -> str:
    """Return what an entity of the right name has instead of what the selector asks for."""
    words = []
    for word, attribute in (("of type", "type"), ("from", "publisher"), ("to", "subscriber"), ("on", "host")):
        wanted = getattr(selector, attribute)
        if not wanted:
            continue
        found = sorted({getattr(one, attribute) for one in subjects} - {""})
        if not any(Pattern.parse(wanted).matches(one) for one in found):
            words.append(f"{word} {' or '.join(found[:MOST_NAMED])}" if found else f"{word} nothing that is known")
    return f", but {', '.join(words)}" if words else ", but not with all of this at once"
