"""The words of a reference document: every key, and what it means."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity

DOCUMENT_KIND = "reference"

REFERENCE_KEYS = {
    "kind": f"what the document is: `{DOCUMENT_KIND}`",
    "name": "of the reference: small letters, digits, `-` and `_`; constraints are called after it",
    "title": "one line on what it is for",
    "text": "more about it",
    "include": "other reference documents whose constraints hold too, as paths relative to this file",
    "namespace": "put before names that do not begin with `/`, here and in what is included; may have wildcards",
    "defaults": "what holds for every constraint of this document that does not say otherwise",
    "constraints": "what is expected of hosts, nodes, processes, topics, connections, services and parameters",
    "fields": "what is expected of fields of messages",
    "chains": "how old data may be at the end of a path over topics",
    "conditions": "conditions with a name, for reactions",
    "reactions": "what is done when something of it does not hold, and when not",
}

TIMING_KEYS = {
    "for": "how long it must be wrong before it is reported (`2 s`); by default at once",
    "recover": "how long it must be fine before that is reported; by default as long as `for`",
    "margin": "how far inside its range a wrong value must come to count as fine, as a share of the bound (`5 %`)",
    "grace": "after something appears, or its clock jumps, nothing is wrong for this long; by default 5 s",
    "window": "over which values are taken; by default sized by the expected period",
}

DEFAULT_KEYS = {
    "severity": "of being broken: note, warning or error; by default warning",
    "group": "under which operators see it",
    **TIMING_KEYS,
}

TOLD_KEYS = {
    "id": "name of the constraint, by default made from what it is about",
    "override": "`true` replaces the constraint of the same `id` in an included or earlier document",
    "text": "message for the operator",
    **DEFAULT_KEYS,
}

KINDS = (
    EntityKind.HOST,
    EntityKind.NODE,
    EntityKind.PROCESS,
    EntityKind.TOPIC,
    EntityKind.CONNECTION,
    EntityKind.SERVICE,
    EntityKind.PARAMETER,
)

SELECTOR_KEYS = {
    "host": "hosts with such a name",
    "node": "nodes with such a name",
    "process": "processes with such a name (`host/pid`)",
    "topic": "topics with such a name",
    "connection": "connections over topics with such a name",
    "service": "services with such a name",
    "parameter": "parameters with such a name (`/node/name`)",
    "type": "only topics and connections with such a message type",
    "publisher": "only topics and connections on which such a node publishes",
    "subscriber": "only connections to such a node",
    "on": "only nodes, processes, connections and parameters on such a host",
    "without": "names to leave out",
}

NARROWING: Mapping[str, tuple[EntityKind, ...]] = {
    "type": (EntityKind.TOPIC, EntityKind.CONNECTION),
    "publisher": (EntityKind.TOPIC, EntityKind.CONNECTION),
    "subscriber": (EntityKind.CONNECTION,),
    "on": (EntityKind.NODE, EntityKind.PROCESS, EntityKind.CONNECTION, EntityKind.PARAMETER),
}
"""Of which kinds a key can narrow the choice."""

EXPECTED_KEY = {
    "expected": "being there: `always` or `while KIND NAME` is there, each name that `{a,b}` lists; `any` or "
    "`any while KIND NAME`, one that matches is enough; `at most one`; `never`"
}

STATE_KEYS = {
    "lifecycle": "state that a managed node has to be in, such as `active`, or a list of those that are fine",
    "value": "what a parameter has to be: a value (`true`), a list of those that are fine, or a range (`0.2..0.5`)",
}

FIELD_KEYS = {
    "topic": "topics with such a name",
    "type": "only topics with such a message type",
    "without": "names to leave out",
    "field": "path of the field: `pose.position.x`, `ranges[0]`",
    "range": "values that are fine, such as `-2..2` or `<= 15`",
    "change": "how much it may change from one message to the next: `-0.5..0.5`; `>= 1` of a counter that must go on",
    "difference": "how much more than the field in `to` it may be: `-0.1..0.1`",
    "to": "the other field of a difference, with its newest value",
    "when": "only while this other field is in this range",
    **TOLD_KEYS,
}

TO_KEYS = {
    "topic": "name of the topic; by default the same",
    "field": "path of the field",
}

WHEN_KEYS = {
    "topic": "name of the topic; by default the same",
    "field": "path of the field",
    "range": "values that enable the check",
}

CHAIN_KEYS = {
    "topics": "names of the topics, the first on which data is stamped, the last on which its age counts",
    "age": "how old it may be there, such as `<= 200 ms`",
    **TOLD_KEYS,
}


def constraint_keys(known: Mapping[str, Quantity]) -> dict[str, str]:
    """Return every key of a constraint; ``known`` are the signals, by key."""
    signals = {
        key: f"{quantity.title}{f' ({quantity.unit})' if quantity.unit else ''}: {quantity.text}"
        for key, quantity in known.items()
    }
    return {**SELECTOR_KEYS, **EXPECTED_KEY, **STATE_KEYS, **signals, **TOLD_KEYS}
