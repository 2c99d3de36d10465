"""The words of the reactions of a reference document: every key, and what it means."""

from __future__ import annotations

from roslens.judge.reference.reference_keys import SELECTOR_KEYS

TIME_KEYS = {
    "for": "it has to be true for so long without a break (`2 s`)",
    "within": "it became true so shortly before or after the condition in `of` did (`5 s`)",
    "of": "the other condition of `within`",
    "after_start": "not before the monitor has watched for so long (`30 s`)",
}

STATEMENT_KEYS = {
    **SELECTOR_KEYS,
    "is": "what they are: of verdicts `ok`, `low`, `high`, `absent`, `bad` (one of these three), `unknown`, "
    "`suspended`; without any constraint `there`, `gone`, `crashed`, `restarted`, `flapping`, `stopped`, `hung`, of "
    "topics `misfit`; or a list of these; one match is enough",
    "signal": "only verdicts on this signal, `presence`, `lifecycle`, or `value` of fields",
    "severity": "only verdicts that are at least so grave",
    "lifecycle": "lifecycle state of a managed node, or a list of these; one match is enough",
    "value": "what a parameter is: a value, a list of values (one match is enough), or a range (`0.2..0.5`)",
    "match": "of all that match `any` (by default), `all`, or `each` on its own: then `{entity}` is the one",
    "effects": "`true` counts faults that another fault explains, too; by default only first causes count",
    "unknown": "what unknown is taken for: `true` or `false`; by default it stays unknown, and nothing is done",
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
    "when": "the condition on which it is begun; what counts are first causes",
    "do": "the actions: one after the other, as long as the one before did not take the cause away",
    "only_while": "another condition that has to be true all the while (arming)",
    "unless": "a condition that must be known to be false (inhibition)",
    "settled": "for how long the first cause must have been the same; by default 2 s",
    "cool_down": "how long after its latest action about an entity it may begin again about it; by default 60 s",
    "at_most": "how many actions it may begin in a time: `3 per 10 min`",
    "mode": "`dry-run`, `ask` or `act`; the more careful one of this and of the command line counts",
    "text": "message for the operator; may hold templates",
    "override": "`true` replaces the reaction of the same `id` in an included or earlier document",
}

STEP_KEYS = {
    "verify": "for how long the cause may still be there after it was done; then the next action follows. Without it "
    "that follows at once",
}
