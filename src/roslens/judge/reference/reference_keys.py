"""The keys of a reference document and their meaning."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.model.entity import EntityKind
from roslens.model.quantity import Quantity

DOCUMENT_KIND = "reference"

REFERENCE_KEYS = {
    "kind": f"what the document is: `{DOCUMENT_KIND}`",
    "name": "of the reference: small letters, digits, `-` and `_`; constraints are called after it",
    "title": "its purpose, in one line",
    "text": "description",
    "include": "other reference documents whose constraints apply too, as paths relative to this file",
    "namespace": "prefix of names that do not begin with `/`, here and in included documents; may have wildcards",
    "defaults": "default values of the keys of every constraint of this document",
    "constraints": "constraints on hosts, nodes, processes, topics, connections, services and parameters",
    "fields": "constraints on fields of messages",
    "chains": "maximum age of data at the end of a path over topics",
    "conditions": "named conditions, for reactions",
    "reactions": "actions on violations, with their conditions",
}

TIMING_KEYS = {
    "for": "how long a violation must last before it is reported (`2 s`); by default it is reported at once",
    "recover": "how long the value must be fine before that is reported; by default as long as `for`",
    "margin": "how far inside its range a wrong value must come to count as fine, as a share of the bound (`5 %`)",
    "grace": "no violation is reported for this long after an entity appears or its clock jumps; by default 5 s",
    "window": "time window that values are computed over; by default derived from the expected period",
}

DEFAULT_KEYS = {
    "severity": "of a violation: note, warning or error; by default warning",
    "group": "heading under which it is shown to operators",
    **TIMING_KEYS,
}

TOLD_KEYS = {
    "id": "name of the constraint, by default derived from its entities",
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
"""The kinds whose selection a key can narrow."""

EXPECTED_KEY = {
    "expected": "presence: `always`, or `while KIND NAME` is present, of each name that `{a,b}` lists; `any` or "
    "`any while KIND NAME`: one match is enough; `at most one` node, server or publisher of each name; `never`. "
    "A topic is there if it has a publisher, a service if it has a server",
    "by": "the end that a topic is expected to have: `publisher` (default) or `subscriber`",
}

STATE_KEYS = {
    "lifecycle": "required state of a managed node, such as `active`, or a list of accepted states",
    "value": "required value of a parameter: a value (`true`), a list of accepted values, or a range (`0.2..0.5`)",
}

FIELD_KEYS = {
    "topic": "topics with such a name",
    "type": "only topics with such a message type",
    "without": "names to leave out",
    "field": "path of the field: `pose.position.x`, `ranges[0]`",
    "range": "accepted values, such as `-2..2` or `<= 15`",
    "change": "accepted change from one message to the next: `-0.5..0.5`; `>= 1` for a counter that must advance",
    "difference": "accepted difference from the field in `to`: `-0.1..0.1`",
    "to": "the other field of a difference, of which the newest value is used",
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
    "topics": "names of the topics: data is stamped on the first, and its age is measured on the last",
    "age": "accepted age there, such as `<= 200 ms`",
    **TOLD_KEYS,
}


def constraint_keys(known: Mapping[str, Quantity]) -> dict[str, str]:
    """Return every key of a constraint; ``known`` are the signals, by key."""
    signals = {
        key: f"{quantity.title}{f' ({quantity.unit})' if quantity.unit else ''}: {quantity.text}"
        for key, quantity in known.items()
    }
    return {**SELECTOR_KEYS, **EXPECTED_KEY, **STATE_KEYS, **signals, **TOLD_KEYS}
