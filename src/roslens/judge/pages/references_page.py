"""The reference page of reference documents and their JSON Schema for editors, generated from the accepted keys."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.judge.pages.reaction_schema import condition_schema, described, named_condition_schema, reaction_schema
from roslens.judge.ranges.amount import UNITS
from roslens.judge.reading.read_state_check import LIFECYCLE
from roslens.judge.reference.expectation import CONDITIONAL, End, PresenceMode
from roslens.judge.reference.reference_keys import (
    CHAIN_KEYS,
    DEFAULT_KEYS,
    DOCUMENT_KIND,
    EXPECTED_KEY,
    FIELD_KEYS,
    KINDS,
    NARROWING,
    REFERENCE_KEYS,
    SELECTOR_KEYS,
    STATE_KEYS,
    TO_KEYS,
    TOLD_KEYS,
    WHEN_KEYS,
    constraint_keys,
)
from roslens.model.finding import Severity
from roslens.model.quantity import Quantity

EXAMPLE = """\
kind: reference
name: front
title: The front of the robot
include: [drive.yaml]
defaults: {for: 2 s, margin: 5 %}
constraints:
  - topic: /scan
    type: sensor_msgs/msg/LaserScan
    rate: 30 Hz ± 10 %
    expected: always
    severity: error
    text: Look at the cable of the lidar.

  # All cameras except those for debugging; the latency limit is for the 95th percentile of a window.
  - topic: /camera_{left,right}/**
    without: [/**/debug/*]
    latency: p95 <= 30 ms
    bandwidth: 1..5 MB/s

  # A single publisher and subscriber.
  - connection: /scan
    publisher: /lidar
    subscriber: /amcl
    loss: <= 1 %

  - host: "**"
    cpu: <= 80 %
    disk_free: ">= 2 GB"

  # All three; `any` would require only one of them.
  - node: "/{lidar,planner,controller}"
    expected: always

  - node: /joy
    expected: while node /teleop

  # The tested configuration, and the state of a managed node.
  - {parameter: /base/max_speed, value: 0.2..0.5}
  - {parameter: "/*/use_sim_time", value: false}
  - {node: /map_server, lifecycle: active}

  # Endpoints that do not match, and processes that are stopped or hung.
  - {topic: "/**", misfits: 0}
  - {node: "/*", stopped: <= 0 s, hung: <= 5 s}

  # Replaces the constraint `wheels` on `rate` of drive.yaml.
  - id: wheels
    override: true
    topic: /odom
    rate: 45..55 Hz

fields:
  - topic: /battery
    field: cells[0].voltage
    range: 3..4.2
    when: {field: present, range: 1}

  # While the robot drives, an encoder keeps counting without jumps, in step with the one on the other side.
  - topic: "/{front,rear}/left/encoder"
    field: ticks
    change: 1..50
    difference: -200..200
    to: {topic: /front/right/encoder, field: ticks}
    when: {topic: /cmd_vel, field: linear.x, range: ">= 0.1"}

chains:
  - topics: [/scan, /map, /cmd_vel]
    age: <= 200 ms
"""

_HEAD = """\
# References

A reference is a YAML document that specifies the expected behaviour of a running robot: acceptable values of signals
of hosts, nodes, processes, topics, connections, services and parameters. `roslens reference check FILE…` reports errors
in documents and the constraints that they add up to; `roslens reference explain FILE… topic:/scan` lists the
constraints on one entity and where they are defined; `roslens reference import FILE` converts a specification of ARNI.
`make docs` generates this page from `src/roslens/judge/`.
[`reference.schema.json`](reference.schema.json) lets editors check and complete such documents. The same documents
define what to do about violations: [reactions](reactions.md). [Trying references](trying_references.md) describes how
to find out what they detect in a recording, what they miss, and what they would do.

```yaml
"""

_AFTER_EXAMPLE = """\
```

Texts are taken literally: `node: no` selects a node named `no`. YAML itself requires quotes around a value that begins
with one of ``* { [ > & ! % @ ` |``, such as `"**/scan"` and `">= 5 Hz"`; `at least 5 Hz` needs none.

## Names and patterns

| pattern | matches |
| --- | --- |
| `*` | any text within one segment of a name, that is, without `/` |
| `**` | any text |
| `?` | one character, but not `/` |
| `{a,b}` | one of these; they may contain patterns and be nested |
| `\\` | the next character literally |
| `re:…` | a regular expression in Python's syntax that matches the whole name, without look-around |

All other characters are literal: `[::1]` is a host. A name that does not begin with `/` is relative to the `namespace`
of the document, or to `/` without one; there `**` matches everything below the namespace. Hosts, processes and types
have no namespace. The namespace of a document is prepended to those of the documents that it includes, so that one
file can describe each robot of a fleet. A name that was recorded without `/` is resolved in the root namespace, as it
is when the recording is played.

`{a,b}` lists names: `expected: always` of `/{lidar,planner}` requires both `/lidar` and `/planner`, and `expected: any`
at least one of them. Of `/camera_*`, one match is enough for either.

## Ranges

| range | meaning |
| --- | --- |
| `25..35 Hz` | from 25 to 35, inclusive; both bounds may have the unit |
| `<= 20 ms`, `at most 20 ms` | upper bound |
| `>= 5 Hz`, `at least 5 Hz` | lower bound |
| `30 Hz ± 10 %`, `30 Hz +- 2 Hz` | a value with a relative or absolute tolerance |
| `p95 <= 30 ms` | this percentile of the values in the window, not their mean |
| `1` | exactly this value; only of signals without a unit |
| `any` | no range; only to remove a constraint with `override` |

A number without a unit is in the unit of the signal. A signal that has not been measured violates nothing: it is
unknown.

"""

_MERGING = """\
## Several documents

All constraints of all documents apply. Included documents come first, then the document itself, then the next one
given. The id of a constraint is `<document>.<id in the document>.<signal>`, with `presence`, `value` or `age` in place
of the signal for `expected`, fields and chains. A constraint replaces an earlier one only if it has the same `id`
(preceded by the name of the document where several have that id) and `override: true`; it keeps the id of the earlier
one.

Two constraints on one signal that an entity could never satisfy together are an error which states both places and such
an entity, and so are `expected: always` and `expected: never` of the same entity.
"""


_FIELDS = """\
At least one of `range`, `change` and `difference` is required. `change` is the value minus that of the previous
message, `difference` the value minus the newest value of the field in `to`; both are computed when a message on `topic`
arrives, so that fields of one message are compared within it. A bad message counts even if the next one is fine before
the next evaluation; with `for`, every message is judged at its own time.
"""

_ALSO = f"""\
and the signals below, each with a range; and the keys of every constraint. Exactly one of
{", ".join(f"`{kind.value}`" for kind in KINDS)} selects the entities.
"""


def references_page(known: Mapping[str, Quantity]) -> str:
    """Return the reference page in Markdown; ``known`` are the signals, by key."""
    units = [f"| {unit or 'none'} | {', '.join(f'`{one}`' for one in sizes)} |" for unit, sizes in UNITS.items()]
    return "\n".join(
        [
            _HEAD + EXAMPLE + _AFTER_EXAMPLE + "| unit of the signal | units accepted |",
            "| --- | --- |",
            *units,
            "",
            _MERGING,
            _keys("## Keys of a reference", REFERENCE_KEYS),
            _keys("## Keys of a constraint", {**SELECTOR_KEYS, **EXPECTED_KEY, **STATE_KEYS}),
            _ALSO,
            _keys("## Keys of every constraint", TOLD_KEYS),
            _keys("## Keys of a field check", _without(FIELD_KEYS)),
            _FIELDS,
            _keys("## Keys of `to`, the field to compare with", TO_KEYS),
            _keys("## Keys of `when`, the condition of a field check", WHEN_KEYS),
            _keys("## Keys of a chain", _without(CHAIN_KEYS)),
            _signals(known),
        ]
    )


def reference_schema(known: Mapping[str, Quantity]) -> dict[str, object]:
    """Return the JSON Schema (2020-12) of a reference document; ``known`` are the signals, by key."""
    severity = {"enum": [severity.value for severity in Severity]}
    amount = {"type": ["string", "number"]}
    texts = {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]}
    word = {"type": ["string", "number", "boolean"]}
    state = {"enum": list(LIFECYCLE)}
    common: dict[str, dict[str, object]] = {
        "severity": dict(severity),
        "override": {"enum": [True, False, "true", "false"]},
        "text": dict(word),
        "group": dict(word),
        "id": {"type": ["string", "number"]},
        **{key: dict(amount) for key in ("for", "recover", "margin", "grace", "window")},
    }
    modes = [mode.value for mode in PresenceMode if mode not in CONDITIONAL]
    kinds = "|".join(kind.value for kind in KINDS)
    constraint = described(
        constraint_keys(known),
        {
            **common,
            "without": texts,
            **{kind.value: dict(word) for kind in KINDS},
            **{key: dict(word) for key in NARROWING},
            **{key: dict(amount) for key in known},
            "lifecycle": {"anyOf": [state, {"type": "array", "minItems": 1, "items": state}]},
            "value": {"anyOf": [dict(word), {"type": "array", "minItems": 1, "items": dict(word)}]},
            "by": {"enum": [end.value for end in End]},
            "expected": {
                "anyOf": [{"enum": modes}, {"type": "string", "pattern": f"^(any\\s+)?while\\s+({kinds})\\s+\\S"}]
            },
        },
    )
    constraint["oneOf"] = [{"required": [kind.value]} for kind in KINDS]
    constraint["anyOf"] = [{"required": [key]} for key in ("expected", *STATE_KEYS, *known)]
    constraint["dependentRequired"] = {"override": ["id"], "by": ["expected"]}
    when = described(WHEN_KEYS, {"range": amount}, "field", "range")
    to = described(TO_KEYS, {}, "field")
    measures = ("range", "change", "difference")
    ranges = {key: dict(amount) for key in measures}
    check = described(FIELD_KEYS, {**common, **ranges, "without": texts, "to": to, "when": when}, "topic", "field")
    check["anyOf"] = [{"required": [key]} for key in measures]
    check["dependentRequired"] = {"difference": ["to"], "to": ["difference"]}
    chain = described(
        CHAIN_KEYS,
        {**common, "age": amount, "topics": {"type": "array", "minItems": 2, "items": {"type": "string"}}},
        "topics",
        "age",
    )
    document = described(
        REFERENCE_KEYS,
        {
            "kind": {"const": DOCUMENT_KIND},
            "name": {"type": "string", "pattern": "^[a-z][a-z0-9_-]*$", "maxLength": 60},
            "title": dict(word),
            "text": dict(word),
            "include": texts,
            "defaults": described(DEFAULT_KEYS, common),
            "constraints": {"type": "array", "items": constraint},
            "fields": {"type": "array", "items": check},
            "chains": {"type": "array", "items": chain},
            "conditions": {"type": "array", "items": named_condition_schema()},
            "reactions": {"type": "array", "items": reaction_schema()},
        },
        "kind",
        "name",
    )
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "roslens reference",
        **document,
        "$defs": {"condition": condition_schema(known)},
    }


def _without(keys: Mapping[str, str]) -> dict[str, str]:
    """Return the keys that are not those of every constraint."""
    return {key: text for key, text in keys.items() if key not in TOLD_KEYS}


def _keys(heading: str, keys: Mapping[str, str]) -> str:
    rows = [f"| `{key}` | {text} |" for key, text in keys.items()]
    return "\n".join([heading, "", "| key | meaning |", "| --- | --- |", *rows, ""])


def _signals(known: Mapping[str, Quantity]) -> str:
    rows = [
        f"| `{key}` | {quantity.unit} | {', '.join(kind.value for kind in KINDS if kind in quantity.kinds)} "
        f"| {' '.join(text for text in (quantity.text, quantity.limits) if text)} |"
        for key, quantity in known.items()
    ]
    return "\n".join(["## Signals", "", "| key | unit | of | meaning |", "| --- | --- | --- | --- |", *rows, ""])
