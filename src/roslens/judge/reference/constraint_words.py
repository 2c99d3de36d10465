"""What a constraint of a reference says, in words."""

from __future__ import annotations

from roslens.judge.reference.alternatives import EACH, alternatives
from roslens.judge.reference.expectation import (
    AgeChain,
    Expectation,
    FieldCheck,
    Presence,
    PresenceMode,
    Selector,
    StateCheck,
)
from roslens.judge.reference.reference_document import Sentence
from roslens.model.entity import EntityKind


def selector_words(selector: Selector) -> str:
    """Return ``connection /scan from /lidar to /amcl on robot1, without /tmp``."""
    words = f"{selector.kind.value} {selector.name}"
    for before, pattern in (
        ("of type", selector.type),
        ("from", selector.publisher),
        ("to", selector.subscriber),
        ("on", selector.host),
    ):
        words += f" {before} {pattern}" if pattern else ""
    return words + (f", without {' and '.join(selector.without)}" if selector.without else "")


def subject_words(sentence: Sentence) -> str:
    """Return what a constraint is about: entities, a field of messages, a path over topics."""
    if isinstance(sentence, FieldCheck):
        words = selector_words(sentence.selector).removeprefix(f"{EntityKind.TOPIC.value} ")
        return f"field {sentence.field} of {words}"
    if isinstance(sentence, AgeChain):
        return f"data over {' > '.join(sentence.topics)}"
    return selector_words(sentence.selector)


def expected_words(sentence: Sentence) -> str:
    """Return what a constraint expects of it: ``rate 25..35 Hz``, ``is there while node /joy is``."""
    if isinstance(sentence, Expectation):
        return f"{sentence.quantity} {sentence.written}"
    if isinstance(sentence, Presence):
        several = sentence.mode in EACH and len(alternatives(sentence.selector.name)) > 1
        if sentence.condition is not None:
            who = "each is" if several else "one is" if sentence.mode is PresenceMode.ANY_WHILE else "is"
            return f"{who} there while {selector_words(sentence.condition)} is"
        return {
            PresenceMode.ALWAYS: "each is always there" if several else "is always there",
            PresenceMode.ANY: "one is always there",
            PresenceMode.NEVER: "is never there",
            PresenceMode.AT_MOST_ONE: "is there at most once",
        }.get(sentence.mode, sentence.mode.value)
    if isinstance(sentence, AgeChain):
        return f"age {sentence.written}"
    if isinstance(sentence, StateCheck):
        return f"{sentence.of.value} {sentence.written}"
    words = f"{sentence.measure.value} {sentence.written}"
    if (other := sentence.other) is not None:
        words = f"difference to {other.topic + ' ' if other.topic else ''}{other.field} {sentence.written}"
    if (condition := sentence.condition) is not None:
        topic = "" if condition.topic in ("", sentence.topic) else f"{condition.topic} "
        words += f" while {topic}{condition.field} is {condition.range}"
    return words
