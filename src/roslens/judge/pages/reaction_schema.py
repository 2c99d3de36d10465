"""The parts of the JSON Schema of references that are about conditions and reactions."""

from __future__ import annotations

from collections.abc import Mapping

from roslens.judge.reading.read_condition_tree import BEING_WORDS, FORMS, OTHER_SIGNALS, VERDICT_WORDS
from roslens.judge.reading.read_state_check import LIFECYCLE
from roslens.judge.reference.reaction_keys import CONDITION_KEYS, NAMED_CONDITION_KEYS, REACTION_KEYS, STEP_KEYS
from roslens.judge.reference.reference_keys import KINDS, NARROWING
from roslens.model.acting.action_kind import ACTION_KINDS, ActionKind, Argument, ArgumentType
from roslens.model.acting.condition import Matching
from roslens.model.acting.reaction import Mode
from roslens.model.finding import Severity
from roslens.model.quantity import Quantity

_WORD: dict[str, object] = {"type": ["string", "number", "boolean"]}
_AMOUNT: dict[str, object] = {"type": ["string", "number"]}
_TEXTS = {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]}
_FLAG = {"enum": [True, False, "true", "false"]}
_CONDITION = {"$ref": "#/$defs/condition"}
_ARGUMENTS: dict[ArgumentType, dict[str, object]] = {
    ArgumentType.TEXT: _WORD,
    ArgumentType.NUMBER: {"type": "number"},
    ArgumentType.WHOLE: {"type": "integer"},
    ArgumentType.FLAG: {"type": "boolean"},
    ArgumentType.DURATION: _AMOUNT,
    ArgumentType.MAPPING: {"type": "object"},
    ArgumentType.ANYTHING: {},
}


def described(keys: Mapping[str, str], types: Mapping[str, Mapping[str, object]], *required: str) -> dict[str, object]:
    """Return the schema of a mapping with these keys and what they mean; a key without a type is a text."""
    properties = {key: {"description": text, **types.get(key, {"type": "string"})} for key, text in keys.items()}
    schema: dict[str, object] = {"type": "object", "additionalProperties": False, "properties": properties}
    return {**schema, "required": list(required)} if required else schema


def condition_schema(known: Mapping[str, Quantity]) -> dict[str, object]:
    """Return the schema of a condition; ``known`` are the signals, by key."""
    several = {"type": "array", "minItems": 1, "items": _CONDITION}
    states = {"enum": [*VERDICT_WORDS, *BEING_WORDS]}
    lifecycle = {"enum": list(LIFECYCLE)}
    schema = described(
        CONDITION_KEYS,
        {
            **{kind.value: _WORD for kind in KINDS},
            **dict.fromkeys(NARROWING, _WORD),
            "without": _TEXTS,
            "all": several,
            "any": several,
            "among": several,
            "not": _CONDITION,
            "of": _CONDITION,
            "at_least": {"type": "integer", "minimum": 1},
            "is": _one_or_more(states),
            "lifecycle": _one_or_more(lifecycle),
            "value": _one_or_more(_WORD),
            "signal": {"enum": [*known, *(word for word in OTHER_SIGNALS if word not in known)]},
            "severity": {"enum": [one.value for one in Severity]},
            "match": {"enum": [one.value for one in Matching]},
            "effects": _FLAG,
            "unknown": _FLAG,
            **dict.fromkeys(("for", "within", "after_start"), _AMOUNT),
        },
    )
    said = [{"required": [key]} for key in ("is", "lifecycle", "value")]
    kinds = [{"required": [kind.value]} for kind in KINDS]
    schema["oneOf"] = [*({"required": [form]} for form in FORMS), {"allOf": [{"oneOf": kinds}, {"oneOf": said}]}]
    schema["dependentRequired"] = {"at_least": ["among"], "among": ["at_least"], "within": ["of"], "of": ["within"]}
    return schema


def named_condition_schema() -> dict[str, object]:
    """Return the schema of a condition with a name."""
    return described(NAMED_CONDITION_KEYS, {"when": _CONDITION}, "id", "when")


def reaction_schema() -> dict[str, object]:
    """Return the schema of a reaction."""
    return described(
        REACTION_KEYS,
        {
            **dict.fromkeys(("when", "only_while", "unless"), _CONDITION),
            **dict.fromkeys(("settled", "cool_down"), _AMOUNT),
            "do": {"type": "array", "minItems": 1, "items": _step()},
            "mode": {"enum": [one.value for one in Mode]},
            "text": _WORD,
            "override": _FLAG,
        },
        "id",
        "when",
        "do",
    )


def _step() -> dict[str, object]:
    keys = {kind.key: kind.summary for kind in ACTION_KINDS}
    schema = described({**keys, **STEP_KEYS}, {**{kind.key: _call(kind) for kind in ACTION_KINDS}, "verify": _AMOUNT})
    schema["oneOf"] = [{"required": [key]} for key in keys]
    return schema


def _call(kind: ActionKind) -> dict[str, object]:
    keys = {one.value: f"the {one.value} that it is done to" for one in kind.targets}
    arguments = {one.name: one.text for one in kind.arguments}
    types = {one.name: _argument(one) for one in kind.arguments}
    required = [one.name for one in kind.arguments if one.required]
    table = described({**keys, **arguments}, types, *required)
    if kind.targets:
        table["oneOf"] = [{"required": [one.value]} for one in kind.targets]
    return {"anyOf": [table, _WORD, {"type": "array"}]}


def _argument(argument: Argument) -> dict[str, object]:
    choices: dict[str, object] = {"enum": list(argument.choices)} if argument.choices else {"type": "string"}
    if argument.type is ArgumentType.NAMES:
        return {"anyOf": [choices, {"type": "array", "items": choices}]}
    if argument.type is ArgumentType.CHOICE:
        return choices
    return dict(_ARGUMENTS.get(argument.type, {"type": "string"}))


def _one_or_more(schema: Mapping[str, object]) -> dict[str, object]:
    return {"anyOf": [schema, {"type": "array", "minItems": 1, "items": schema}]}
