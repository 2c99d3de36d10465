"""The reference page of reactions, generated from the accepted keys."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.judge.reference.reaction_keys import (
    NAMED_CONDITION_KEYS,
    REACTION_KEYS,
    STATEMENT_KEYS,
    STEP_KEYS,
    TIME_KEYS,
    TREE_KEYS,
)
from roslens.judge.reference.reference_keys import SELECTOR_KEYS
from roslens.judge.reference.template import FIELDS
from roslens.model.acting.action_kind import ACTION_KINDS

EXAMPLE = """\
kind: reference
name: front
constraints:
  - {topic: /scan, rate: 8..12 Hz, expected: always, severity: error}
  - {node: /lidar, expected: always, severity: error}

conditions:
  - id: driving
    when: {node: /base, lifecycle: active}

reactions:
  # The lidar driver crashed or is stopped: restart it; if it is not back within 10 s, stop the robot.
  - id: lidar
    text: "{entity} on {host} is {state}"
    when: {node: /lidar, is: [crashed, stopped], for: 2 s}
    only_while: {condition: driving}
    unless: {parameter: /base/maintenance, value: true}
    cool_down: 1 min
    at_most: 5 per h
    do:
      - notify: "{entity} is {state}: it is restarted"
      - restart: {node: "{entity}"}
        verify: 10 s
      - publish:
          topic: /emergency_stop
          type: std_msgs/msg/Bool
          fields: {data: true}
          how: repeated

  # Whatever the cause, stop a robot without scans.
  - id: blind
    when:
      all:
        - {topic: /scan, is: [absent, low], signal: rate, effects: true, for: 500 ms}
        - {condition: driving}
    settled: 0 s
    do:
      - publish: {topic: /emergency_stop, type: std_msgs/msg/Bool, fields: {data: true}}
"""

TIME_LINE = """\
given:
  - {at: 0 s, node: /lidar, is: there, host: robot-1}
  - {at: 0 s, node: /base, lifecycle: active}
  - {at: 0 s, parameter: /base/maintenance, value: "false"}
  - {at: 0 s, topic: /scan, signal: rate, is: ok}
  - {at: 20 s, node: /lidar, is: crashed}
  - {at: 21 s, topic: /scan, signal: rate, is: absent, cause: "node:/lidar"}
until: 40 s
expect:
  - {at: 21.5 s, reaction: front.blind, action: publish}
  - {at: 22 s, reaction: front.lidar, action: notify, entity: "node:/lidar"}
  - {at: 22 s, reaction: front.lidar, action: restart}
  - {at: 32 s, reaction: front.lidar, action: publish}
"""

_HEAD = """\
# Reactions

The section `reactions` of a [reference](references.md) defines what to do about violations: a condition, and a chain of
actions; each action follows if the previous one did not remove the cause. No action is taken unless `roslens react`
runs in a mode that acts; `roslens react --simulate` reports what would have been done, when and why. `make docs`
generates this page from `src/roslens/judge/`.

```yaml
"""

_AFTER = """\
```

## When a condition is true

A condition is true, false or **unknown**, and only a true condition triggers actions. It is unknown without a verdict:
no constraint covers it, its observer is silent, the clock does not advance, or the first cause has not been the same
for long enough. `not` of unknown is unknown; `all` is false if one part is false, otherwise unknown if one is; `any` is
true if one part is true, otherwise unknown if one is. A statement may set the value to use for unknown
(`unknown: false`), and `is: unknown` tests for it.

Nodes that disappear together with all others of their host, within 10 s, are unknown as well: the host is off, or all
of them were shut down, and restarting each would be wrong. What an observer watches stays unknown until 3 s after the
observer reports again.

A node is `crashed` if its process ended by a signal or with an error (`gone` is any node that left). The host on which
it ran sees the exit status: code 0, SIGINT, SIGTERM and SIGHUP are an end in order. Where the kernel keeps no status
for others than the parent (before Linux 6.15), a node that took its leave from the graph ended in order, and one that
was still in it crashed. What somebody ended in order is not started again by `restart` and `start`, whatever their
condition, unless they are given `after_orderly_end: true`; the journal has an entry `spared` then. A Python node that
does not handle `ExternalShutdownException` ends on SIGTERM with exit code 1, which cannot be told from an error.

A reaction with `match: any` can start again once its condition is no longer true of any entity. Entities that have
ended meanwhile, or were never judged, do not prevent that; a host that is no longer sampled does, if it was judged
before: its fault may persist.

Everything is unknown while the monitor itself is impaired: until its observers have seen for 5 s and no further node
was found for 3 s (after 30 s at the latest), while its evaluations are late, while it sheds records, and after its
clock was set. The journal has `well` once it is fit. Hold times (`for`) then restart. The hold time of silence
(`absent`) counts from the last message, any other from the first report.

A bad verdict counts only as a **first cause**: if another fault explains it, that fault is the one to repair.
`effects: true` counts both, which is right for stopping the robot and wrong for a restart. The cause must have been the
same for the `settled` time of the reaction.

By default, one of the entities that a pattern selects is enough (`match: any`). With `match: all`, all known entities
must match. With `match: each`, the reaction applies to each of them separately, with hold times, cool-downs and chains
of its own, and `{entity}` is that entity. `for` counts per entity.

## The chain of actions

Actions are carried out in order. After an action with `verify`, the condition has to become false within that time,
otherwise the next one follows; if the condition is unknown at the end of that time, the next one waits until it is
known. The chain ends when the condition becomes false, and can start again after the cool-down. If the last action did
not help either, nothing more is done until the condition has been false.

An action that failed, or that reached its limit, is followed by the next one at once; if a gate refused it or all
reactions are on hold, the chain ends.

`{entity}`, `{host}` and `{cause}` may name a target; the other fields are for texts. Names of targets have no
wildcards: use `match: each` to act on each of several entities.

## Errors in documents

Conditions that are never or always true, cyclic named conditions, unknown actions, missing or unknown arguments, values
of the wrong type, templates with unknown fields, a target that nothing fills, and two documents where one stops what
the other starts are errors, reported with `file:line:column`. `roslens reference check FILE… --bag FILE` reports
targets that do not exist in a recording. Unknown messages, services and fields are rejected there and by
`roslens react`, as far as their definitions are installed.

## Testing reactions

```yaml
"""

_AFTER_TIME_LINE = """\
```

If it is saved as `front.test.yaml` next to `front.yaml`, `roslens reference test front.yaml` runs it, and `roslens
react --simulate front.yaml --timeline front.test.yaml` prints what would have been done. `given` lists what is known
from an instant on: `is` of verdicts (with `signal`, `severity`, `cause` and `value`) and of entities, `lifecycle`
states and `value`s of parameters. `expect` lists every decision, each within 0.5 s of `at` or within the tolerance
`within`; without `expect`, no action may be taken. `tests` is a list of such time lines, each with a `name`. Kinds of
actions that `done` lists as failed (`done: {restart: failed}`) fail; all others succeed.

"""


def reactions_page() -> str:
    """Return the reference page in Markdown."""
    statement = {key: text for key, text in STATEMENT_KEYS.items() if key not in SELECTOR_KEYS}
    fields = {f"{{{name}}}": text for name, text in FIELDS.items()}
    actions = {one.key: one.summary for one in ACTION_KINDS}
    return "\n".join(
        [
            _HEAD + EXAMPLE + _AFTER + TIME_LINE + _AFTER_TIME_LINE + _keys("## Keys of a reaction", REACTION_KEYS),
            _keys("## Keys of a step besides its action", STEP_KEYS),
            _keys("## Actions", actions),
            _keys("## Keys of a condition", TREE_KEYS),
            "or a statement on entities, selected as in a [constraint](references.md#keys-of-a-constraint):",
            "",
            _keys("## Keys of a statement", statement),
            _keys("## Time keys of any condition", TIME_KEYS),
            _keys("## Keys of a named condition", NAMED_CONDITION_KEYS),
            _keys("## Fields of templates", fields),
        ]
    )


def _keys(heading: str, keys: Mapping[str, str]) -> str:
    rows = [f"| `{key}` | {text} |" for key, text in keys.items()]
    return "\n".join([heading, "", "| key | meaning |", "| --- | --- |", *rows, ""])
