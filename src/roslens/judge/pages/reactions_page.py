"""The reference page of reactions, made from what reads them."""

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
  # The driver of the lidar is gone or stopped: start it again, twice as long as that does not help stop the robot.
  - id: lidar
    text: "{entity} on {host} is {state}"
    when: {node: /lidar, is: [gone, stopped], for: 2 s}
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

  # Whatever the cause, a robot without scans does not drive.
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
  - {at: 20 s, node: /lidar, is: gone}
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

Under `reactions` a [reference](references.md) says what is done when something of it does not hold: a condition, and a
chain of actions; each next one follows where the previous one did not remove the cause. Nothing of it is done
unless `roslens react` runs in a mode that acts; `roslens react --simulate` says what would have been done, when and
why. This page is made from `src/roslens/judge/`; `make docs` writes it anew.

```yaml
"""

_AFTER = """\
```

## When a condition is true

A condition is true, false or **unknown**, and only what is true is acted upon. It is unknown where nothing is judged:
no constraint covers it, its observer is silent, time stands still, or the first cause has not been the same for long
enough. `not` of unknown is unknown; `all` is false where one part is false, else unknown where one is; `any` is true
where one part is true, else unknown where one is. A statement may say what unknown is taken for (`unknown: false`),
and that something *is* unknown can be asked for (`is: unknown`).

Nodes that go together with all others of their host, within 10 s, are unknown as well: the host is off, or somebody
ended them, and starting each of them again would be wrong. What an observer watches stays unknown until 3 s after it is
heard again.

A reaction about any of a pattern begins anew once its condition is no longer true of any entity. What has ended
meanwhile, or was never judged, does not keep it from that; a host that is no longer sampled does, if it was judged
before: what was wrong with it may still be.

Everything is unknown while the monitor itself is not well: in its first seconds, while its looks come late, while it
sheds records, and after its clock was set. A hold time (`for`) then begins anew. That of
silence (`absent`) counts from when nothing came any more, any other from when it was reported.

A verdict that is bad counts only as a **first cause**: where another fault explains it, that one is to be repaired.
`effects: true` takes both, which is right for a stop of the robot and wrong for a restart. The cause must have been the
same for the `settled` time of the reaction.

Of the entities that a pattern selects one is enough (`match: any`). With `match: all` each that is known has to be so.
With `match: each` the reaction is about each of them on its own, with hold times, cool-downs and chains of its own, and
`{entity}` is that one. `for` counts per entity.

## What is done, and what follows

Actions are done one after the other. After one with `verify`, the condition has to become false within that time, else
the next one follows; where it is unknown at the end of that time, the next one waits until that is known. When the
condition becomes false the chain ends, and it can begin anew after the cool-down. When the last action did not help
either, nothing more is done until the condition has been false.

An action that failed, or that reached its limit, is followed by the next one at once; where a gate refused it or
everything is on hold, the chain ends.

`{entity}`, `{host}` and `{cause}` may name a target; the other fields are for texts. Names of targets have no
wildcards: what is to be done to each of several wants `match: each`.

## What is refused

Conditions that can never be true or always are, circles of named conditions, unknown actions, missing or unknown
arguments, values of the wrong type, templates that name what there is not, a target that nothing fills, and two
documents where one ends what the other starts: each with `file:line:column`. `roslens reference check FILE…
--bag FILE` says which targets were not there in a recording. Messages, services and fields that do not exist are
refused there and by `roslens react`, as far as their definitions are here.

## Trying it

```yaml
"""

_AFTER_TIME_LINE = """\
```

Saved as `front.test.yaml` beside `front.yaml`, `roslens reference test front.yaml` runs it, and `roslens react
--simulate front.yaml --timeline front.test.yaml` prints what would have been done. `given` is what is known from an
instant on: `is` of verdicts (with `signal`, `severity`, `cause` and `value`) and of entities, `lifecycle` states and
`value`s of parameters. `expect` lists every decision, each within 0.5 s of `at` unless `within` says otherwise; no
`expect` means that nothing may be done. `tests` is a list of such time lines with a `name`. Actions that `done:
failed` names come out so; others count as done.

"""


def reactions_page() -> str:
    """Return the reference page in Markdown."""
    statement = {key: text for key, text in STATEMENT_KEYS.items() if key not in SELECTOR_KEYS}
    fields = {f"{{{name}}}": text for name, text in FIELDS.items()}
    actions = {one.key: one.summary for one in ACTION_KINDS}
    return "\n".join(
        [
            _HEAD + EXAMPLE + _AFTER + TIME_LINE + _AFTER_TIME_LINE + _keys("## Keys of a reaction", REACTION_KEYS),
            _keys("## Keys of a step beside its action", STEP_KEYS),
            _keys("## Actions", actions),
            _keys("## Keys of a condition", TREE_KEYS),
            "or a statement about entities, selected as in a [constraint](references.md#keys-of-a-constraint):",
            "",
            _keys("## Keys of a statement", statement),
            _keys("## Keys that add time to any condition", TIME_KEYS),
            _keys("## Keys of a named condition", NAMED_CONDITION_KEYS),
            _keys("## Fields of templates", fields),
        ]
    )


def _keys(heading: str, keys: Mapping[str, str]) -> str:
    rows = [f"| `{key}` | {text} |" for key, text in keys.items()]
    return "\n".join([heading, "", "| key | meaning |", "| --- | --- |", *rows, ""])
