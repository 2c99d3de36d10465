"""The reference page of reference documents and the JSON Schema for editors, made from what reads them."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.judge.pages.reaction_schema import condition_schema, described, named_condition_schema, reaction_schema
from roslens.judge.ranges.amount import UNITS
from roslens.judge.reading.read_state_check import LIFECYCLE
from roslens.judge.reference.expectation import CONDITIONAL, PresenceMode
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

  # Every camera but those for debugging; the 95th of 100 values in a window counts.
  - topic: /camera_{left,right}/**
    without: [/**/debug/*]
    latency: p95 <= 30 ms
    bandwidth: 1..5 MB/s

  # What one node receives from one other.
  - connection: /scan
    publisher: /lidar
    subscriber: /amcl
    loss: <= 1 %

  - host: "**"
    cpu: <= 80 %
    disk_free: ">= 2 GB"

  # Each of the three; `any` would be content with one of them.
  - node: "/{lidar,planner,controller}"
    expected: always

  - node: /joy
    expected: while node /teleop

  # In the configuration it was tested with, and up.
  - {parameter: /base/max_speed, value: 0.2..0.5}
  - {parameter: "/*/use_sim_time", value: false}
  - {node: /map_server, lifecycle: active}

  # What joins nothing, and what stands still.
  - {topic: "/**", misfits: 0}
  - {node: "/*", stopped: <= 0 s, hung: <= 5 s}

  # Takes the place of what `wheels` of drive.yaml says of `rate`.
  - id: wheels
    override: true
    topic: /odom
    rate: 45..55 Hz

fields:
  - topic: /battery
    field: cells[0].voltage
    range: 3..4.2
    when: {field: present, range: 1}

  # An encoder counts on while the wheel turns, makes no jumps, and stays with the one on the other side.
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

A reference is a YAML document that says how a running robot should behave: which values of which signals of which
hosts, nodes, processes, topics, connections, services and parameters are fine. `roslens reference check FILE…` says
what is wrong with documents and what they expect together; `roslens reference explain FILE… topic:/scan` tells what is
expected of one entity, and where that stands; `roslens reference import FILE` makes a reference of a specification of
ARNI. This page is made from `src/roslens/judge/`; `make docs` writes it anew.
[`reference.schema.json`](reference.schema.json) lets editors check and complete such documents. What is done where
something does not hold stands in the same documents: [reactions](reactions.md).
[Trying references](trying_references.md) says what they see in a recording, what they miss, and what they would do.

```yaml
"""

_AFTER_EXAMPLE = """\
```

Texts are taken as written: `node: no` is about a node named `no`. YAML itself wants quotes around a value that begins
with one of ``* { [ > & ! % @ ` |``, such as `"**/scan"` and `">= 5 Hz"`; `at least 5 Hz` needs none.

## Names and patterns

| written | is |
| --- | --- |
| `*` | any text within one segment of a name, that is, without `/` |
| `**` | any text |
| `?` | one character, but not `/` |
| `{a,b}` | one of these; they may hold patterns and each other |
| `\\` | the next character as it is |
| `re:…` | a regular expression in Python's syntax that matches the whole name, without look-around |

Everything else stands for itself: `[::1]` is a host. A name that does not begin with `/` is below the `namespace` of
the document; without one, below `/`. There `**` means everything below the namespace. Hosts, processes and types are in
no namespace. The namespace of a document goes before that of what it includes, so that one file can describe each
robot of a fleet. A name that was recorded without `/` is the one below the root that playing the recording makes of it.

`{a,b}` lists names: `expected: always` of `/{lidar,planner}` is about `/lidar` and `/planner`, each on its own, and
`expected: any` about the two together. Of `/camera_*` one match is enough for both.

## Ranges

| written | is |
| --- | --- |
| `25..35 Hz` | from 25 to 35, bounds included; the unit may stand at both ends |
| `<= 20 ms`, `at most 20 ms` | up to a bound |
| `>= 5 Hz`, `at least 5 Hz` | from a bound on |
| `30 Hz ± 10 %`, `30 Hz +- 2 Hz` | around a value, by a share of it or by an amount |
| `p95 <= 30 ms` | this percentile of the values in the window, not their mean |
| `1` | exactly this, only of what has no unit |
| `any` | nothing; only to take a constraint away with `override` |

A number without a unit is in the unit of the signal. A signal that has not been measured breaks nothing: it is unknown.

"""

_MERGING = """\
## Several documents

All constraints of all documents hold. What is included comes first, then the document itself, then the next one given.
The id of a constraint is `<document>.<id in the document>.<signal>`, with `presence`, `value` or `age` in the place of
the signal for `expected`, fields and chains. A constraint takes the place of an earlier one only where its constraint
has the same `id` (with the name of the document before it where several have that id) and says `override: true`; the
id of the earlier one stays.

Two constraints on one signal that some entity could never satisfy both are an error which names both places and such an
entity, and so are `expected: always` and `expected: never` of the same.
"""


_FIELDS = """\
At least one of `range`, `change` and `difference` has to be there. `change` is the value less that of the message
before, `difference` the value less the newest one of the field in `to`; both are taken when a message on `topic` comes,
so that fields of one message are compared within it. A message that is wrong counts although the next one is fine
before anybody looks; with `for` every message is judged at its time.
"""

_ALSO = f"""\
and the signals below, each with a range; and the keys of every constraint. Exactly one of
{", ".join(f"`{kind.value}`" for kind in KINDS)} selects.
"""


def references_page(known: Mapping[str, Quantity]) -> str:
    """Return the reference page in Markdown; ``known`` are the signals, by key."""
    units = [f"| {unit or 'none'} | {', '.join(f'`{one}`' for one in sizes)} |" for unit, sizes in UNITS.items()]
    return "\n".join(
        [
            _HEAD + EXAMPLE + _AFTER_EXAMPLE + "| unit of the signal | may be written in |",
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
            _keys("## Keys of the field it is compared with", TO_KEYS),
            _keys("## Keys of its condition", WHEN_KEYS),
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
            "expected": {
                "anyOf": [{"enum": modes}, {"type": "string", "pattern": f"^(any\\s+)?while\\s+({kinds})\\s+\\S"}]
            },
        },
    )
    constraint["oneOf"] = [{"required": [kind.value]} for kind in KINDS]
    constraint["anyOf"] = [{"required": [key]} for key in ("expected", *STATE_KEYS, *known)]
    constraint["dependentRequired"] = {"override": ["id"]}
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
