"""The lists of a reference document: constraints, fields and chains."""

from __future__ import annotations

from collections.abc import Iterator

from roslens.judge.documents.document import Section
from roslens.judge.ranges.amount import Limits, parse_limits
from roslens.judge.ranges.range import Range
from roslens.judge.reading.read_common_keys import declared, details_of, plain_range, prefixed, reading, slug, squeezed
from roslens.judge.reading.read_field_check import read_field_checks
from roslens.judge.reading.read_selector import read_condition, read_name, read_selector
from roslens.judge.reading.read_state_check import has_states, read_state_checks
from roslens.judge.reference.alternatives import alternatives
from roslens.judge.reference.expectation import (
    CONDITIONAL,
    AgeChain,
    End,
    Expectation,
    Presence,
    PresenceMode,
    Selector,
)
from roslens.judge.reference.reference_document import Declared, Scope
from roslens.judge.reference.reference_keys import CHAIN_KEYS, FIELD_KEYS, KINDS, constraint_keys
from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity
from roslens.plugins.nearest import did_you_mean


def read_constraints(document: Section, scope: Scope) -> Iterator[Declared]:
    """Yield every constraint of a document in the order of its lists.

    Raises:
        DocumentError: a constraint is wrong, with its place.
    """
    for section in document.sections("constraints", "constraint", constraint_keys(scope.known)):
        yield from _constraint(section, scope)
    for section in document.sections("fields", "field check", FIELD_KEYS):
        yield from read_field_checks(section, scope)
    for section in document.sections("chains", "chain", CHAIN_KEYS):
        yield _chain(section, scope)


def _constraint(section: Section, scope: Scope) -> Iterator[Declared]:
    selector = read_selector(section, scope)
    name = prefixed(scope, section, _default_name(selector))
    signals = [quantity for key, quantity in scope.known.items() if key in section]
    if not signals and "expected" not in section and not has_states(section):
        example = next((key for key, quantity in scope.known.items() if selector.kind in quantity.kinds), "")
        raise section.fault(
            "",
            "a constraint that expects nothing",
            expected=f"a signal with a range, such as `{example}`, or `expected`" if example else "`expected: always`",
        )
    if "by" in section and "expected" not in section:
        raise section.fault("by", "'by' without `expected`", expected="`expected: always`, or no 'by'")
    if "expected" in section:
        constraint = _presence(section, scope, selector, name)
        yield declared(section, scope, constraint, name, "expected")
    yield from read_state_checks(section, scope, selector, name)
    for quantity in signals:
        limits = _limits(section, quantity, selector)
        expectation = Expectation(
            details=details_of(section, scope, name, quantity.key, quantity.key),
            selector=selector,
            quantity=quantity.key,
            range=limits.range,
            written=squeezed(section.text(quantity.key)),
            percentile=limits.percentile,
        )
        yield declared(section, scope, expectation, name, quantity.key, void=limits.range == Range())


def _limits(section: Section, quantity: Quantity, selector: Selector) -> Limits:
    key = quantity.key
    if selector.kind not in quantity.kinds:
        kinds = " or ".join(kind.value for kind in KINDS if kind in quantity.kinds)
        raise section.fault(key, f"{key!r} is not measured of a {selector.kind.value}", expected=f"it of a {kinds}")
    text = section.text(key)
    limits = reading(section, key, lambda: parse_limits(text, quantity.unit))
    sensible = Range(quantity.minimum, quantity.maximum)
    if not limits.range.overlaps(sensible):
        raise section.fault(key, f"{key}: no value can be in {text!r}", expected=f"a part of {sensible}")
    return limits


def _presence(section: Section, scope: Scope, selector: Selector, name: str) -> Presence:
    words = section.text("expected")
    details = details_of(section, scope, name, "presence", "expected")
    reading(section, selector.kind.value, lambda: alternatives(selector.name))
    by = _end(section, selector, words)
    for mode in CONDITIONAL:
        if words.startswith(f"{mode.value} "):
            condition = read_condition(section, scope, "expected", words.removeprefix(mode.value).strip())
            return Presence(details, selector, mode, condition, by)
    modes = [mode.value for mode in PresenceMode if mode not in CONDITIONAL]
    if words not in modes:
        valid = [f"{mode.value} KIND NAME" if mode in CONDITIONAL else mode.value for mode in PresenceMode]
        expected = f"one of {', '.join(valid)}"
        raise section.fault("expected", f"expected is {words!r}", expected=expected, advice=did_you_mean(words, valid))
    return Presence(details, selector, PresenceMode(words), by=by)


def _end(section: Section, selector: Selector, words: str) -> End:
    """Return the end of a topic that has to be there."""
    if "by" not in section:
        return End.PUBLISHER
    if selector.kind is not EntityKind.TOPIC or words == PresenceMode.NEVER.value:
        found = f"'by' of a {selector.kind.value}, which is expected {words}"
        raise section.fault("by", found, expected="it of a topic that has to be there")
    return section.choice("by", End)


def _chain(section: Section, scope: Scope) -> Declared:
    topics = tuple(read_name(section, scope, "topics", text) for text in section.texts("topics"))
    if len(topics) < 2:
        raise section.fault(
            "topics", f"a chain over {len(topics)} topics", expected="two or more, in the order of the data"
        )
    if len(set(topics)) < len(topics):
        twice = next(topic for topic in topics if topics.count(topic) > 1)
        raise section.fault("topics", f"{twice!r} twice in a chain", expected="each topic once")
    name = prefixed(scope, section, slug("chain", topics[0], topics[-1]))
    chain = AgeChain(
        details=details_of(section, scope, name, "age", "age"),
        topics=topics,
        range=plain_range(section, "age", "s"),
        written=squeezed(section.text("age")),
    )
    return declared(section, scope, chain, name, "age", void=chain.range == Range())


def _default_name(selector: Selector) -> str:
    return slug(selector.kind.value, selector.name, selector.publisher, selector.subscriber, selector.host)
