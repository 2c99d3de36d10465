"""Sentences that are about nothing that is there: a typing error mostly, or a part that was never started."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence

import msgspec

from roslens.judge.expectation import AgeChain, FieldCheck, Presence, PresenceMode, Reference, Selector
from roslens.judge.merge_references import sentences_of
from roslens.judge.pattern import Pattern
from roslens.judge.pattern_index import PatternIndex
from roslens.judge.reference_document import Sentence
from roslens.judge.sentence_words import selector_words
from roslens.model.entity import EntityKind
from roslens.model.graph import Graph, Role
from roslens.plugins.nearest import did_you_mean


class Subject(msgspec.Struct, frozen=True, order=True):
    """An entity with what selectors ask for; what is unknown is empty."""

    kind: EntityKind
    name: str
    host: str = ""
    type: str = ""
    publisher: str = ""
    subscriber: str = ""


class Unmatched(msgspec.Struct, frozen=True):
    """A sentence, the part of it that matches nothing, and what might have been meant."""

    sentence: Sentence
    selector: Selector
    advice: str = ""

    def __str__(self) -> str:
        """Return it in the message form."""
        told = self.sentence.told
        text = f"{told.where}: {told.id} is about nothing: no {selector_words(self.selector)} is there"
        return f"{text}. {self.advice}" if self.advice else text


def unmatched(reference: Reference, subjects: Iterable[Subject]) -> list[Unmatched]:
    """Return the sentences that match nothing, sorted by id.

    That something must always be there, or never, is about what is not there too, and so never among them.

    Args:
        reference: what is expected.
        subjects: everything that has been seen.
    """
    asked = [(selector, sentence) for sentence in sentences_of(reference) for selector in _selectors(sentence)]
    index = PatternIndex((selector, number) for number, (selector, _) in enumerate(asked))
    matched: set[int] = set()
    names: dict[EntityKind, set[str]] = defaultdict(set)
    for subject in subjects:
        names[subject.kind].add(subject.name)
        matched.update(_find(index, subject))
    return [
        Unmatched(sentence, selector, _advice(selector, names[selector.kind]))
        for number, (selector, sentence) in enumerate(asked)
        if number not in matched
    ]


def subjects_of(graph: Graph) -> tuple[Subject, ...]:
    """Return everything that selectors can be about in a graph, sorted."""
    found = {Subject(EntityKind.HOST, host) for host in graph.hosts}
    found |= {Subject(EntityKind.PROCESS, f"{process.host}/{process.pid}", process.host) for process in graph.processes}
    hosts = {node.name: node.host for node in graph.nodes}
    found |= {Subject(EntityKind.NODE, name, host) for name, host in hosts.items()}
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
            Subject(EntityKind.CONNECTION, topic, hosts.get(subscriber, ""), type_, publisher, subscriber)
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


def _selectors(sentence: Sentence) -> tuple[Selector, ...]:
    """Return what a sentence needs to be there to be about something."""
    if isinstance(sentence, Presence):
        if sentence.mode in (PresenceMode.ALWAYS, PresenceMode.NEVER, PresenceMode.AT_MOST_ONE):
            return ()
        return (sentence.condition,) if sentence.condition is not None else ()
    if isinstance(sentence, FieldCheck):
        topics = {sentence.topic, sentence.condition.topic if sentence.condition else sentence.topic}
        return tuple(Selector(EntityKind.TOPIC, _escaped(topic)) for topic in sorted(topics))
    if isinstance(sentence, AgeChain):
        return tuple(Selector(EntityKind.TOPIC, _escaped(topic)) for topic in sentence.topics)
    return (sentence.selector,)


def _escaped(name: str) -> str:
    return "".join(f"\\{char}" if char in "*?{},\\" else char for char in name)


def _advice(selector: Selector, names: set[str]) -> str:
    literal = Pattern.parse(selector.name).literal
    if literal is None or literal in names:
        return ""
    return did_you_mean(literal, names)
