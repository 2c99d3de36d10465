"""The keys of reactions in a reference document and their meaning."""

from __future__ import annotations

from roslens.judge.reference.reference_keys import SELECTOR_KEYS

TIME_KEYS = {
    "for": "how long it has to be true without interruption (`2 s`)",
    "within": "maximum time between its becoming true and that of the condition in `of`, in either order (`5 s`)",
    "of": "the other condition of `within`",
    "after_start": "how long the monitor must have been running (`30 s`)",
}

STATEMENT_KEYS = {
    **SELECTOR_KEYS,
    "is": "their state: verdicts `ok`, `low`, `high`, `absent`, `bad` (one of these three), `unknown`, `suspended`; "
    "without any constraint `there`, `gone`, `crashed`, `restarted`, `flapping`, `stopped`, `hung`, and `misfit` of "
    "topics; or a list of these; one match is enough",
    "signal": "only verdicts on this signal, `presence`, `lifecycle`, or `value` of fields",
    "severity": "only verdicts of at least this severity",
    "lifecycle": "lifecycle state of a managed node, or a list of these; one match is enough",
    "value": "value of a parameter: a value, a list of values (one match is enough), or a range (`0.2..0.5`)",
    "match": "`any` (by default) or `all` of the selected entities, or `each` separately: then `{entity}` is that one",
    "effects": "`true` also counts faults that another fault explains; by default only first causes count",
    "unknown": "value to use for unknown: `true` or `false`; by default it stays unknown, and nothing is done",
}

TREE_KEYS = {
    "all": "a list of conditions that all have to be true",
    "any": "a list of conditions; at least one has to be true",
    "not": "a condition that has to be false",
    "at_least": "how many of the conditions in `among` have to be true",
    "among": "the list of conditions of `at_least`",
    "condition": "name of a condition in `conditions`",
}

CONDITION_KEYS = {**TREE_KEYS, **STATEMENT_KEYS, **TIME_KEYS}

NAMED_CONDITION_KEYS = {"id": "name of the condition, for `condition: NAME`", "when": "the condition"}

REACTION_KEYS = {
    "id": "name of the reaction",
    "when": "the condition that starts it; only first causes count",
    "do": "the actions: one after the other, as long as the previous one did not remove the cause",
    "only_while": "another condition that has to be true throughout (arming)",
    "unless": "a condition that must be known to be false (inhibition)",
    "settled": "for how long the first cause must have been the same; by default 2 s",
    "cool_down": "minimum time from its latest action on an entity to its next start for that entity; by default 60 s",
    "at_most": "maximum number of actions in a time: `3 per 10 min`",
    "mode": "`dry-run`, `ask` or `act`; the more cautious of this and the command line applies",
    "text": "message for the operator; may hold templates",
    "override": "`true` replaces the reaction of the same `id` in an included or earlier document",
}

STEP_KEYS = {
    "verify": "how long the cause may persist after the action; then the next action follows. Without it, the next one "
    "follows at once",
}
