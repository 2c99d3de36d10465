"""What is done when a condition comes true: reactions as documents have them, and what becomes of each."""

from __future__ import annotations

from enum import Enum
from typing import Any

import msgspec

from roslens.model.acting.condition import Condition
from roslens.model.entity import EntityId

SETTLED_S = 2.0
"""For how long the first cause has to have been the same, unless a reaction sets it."""
COOL_DOWN_S = 60.0


class Mode(str, Enum):
    """What a decision leads to: a line in the journal, a question, or the action."""

    DRY_RUN = "dry-run"
    ASK = "ask"
    ACT = "act"


class ActionCall(msgspec.Struct, frozen=True, omit_defaults=True):
    """One action, as a document has it or with its templates filled.

    Texts may hold templates, such as ``{entity}``: in a reaction they stand as written, in a decision they are filled.

    Attributes:
        kind: key of the action, one of ``model.action_kind``.
        target: of an action that needs one: whose name may hold templates, too; without wildcards.
        arguments: by name, in JSON's types; those that are left out have the default of the kind.
        place: ``file:line:column``.
    """

    kind: str
    target: EntityId | None = None
    arguments: dict[str, Any] = {}
    place: str = ""


class EscalationStep(msgspec.Struct, frozen=True, omit_defaults=True):
    """One step of a chain: an action, and how long it has to take the cause away.

    Attributes:
        action: what is done.
        verify_within_s: seconds after it was done within which the condition has to become false; else the next step
            follows. None goes on with the next step at once.
    """

    action: ActionCall
    verify_within_s: float | None = None


class Reaction(msgspec.Struct, frozen=True, omit_defaults=True):
    """What is done when, and how often at most.

    Attributes:
        name: ``<document>.<id>``, unique.
        when: what has to be true.
        steps: what is done, the next one where the one before did not help.
        only_while: what else has to be true (arming); None for nothing.
        unless: what must not be true (inhibition): while it is true or unknown nothing is decided. None for nothing.
        settled_s: seconds for which the first cause has to have been the same.
        cool_down_s: seconds from the last decision about an entity until a chain about it may begin again.
        at_most: decisions about all entities together in ``per_s`` seconds; 0 for any number.
        per_s: seconds that ``at_most`` is about.
        mode: what decisions lead to where it is not what the command line says; it can only be the more careful one.
        text: message for the operator.
        place: ``file:line:column``.
    """

    name: str
    when: Condition
    steps: tuple[EscalationStep, ...]
    only_while: Condition | None = None
    unless: Condition | None = None
    settled_s: float = SETTLED_S
    cool_down_s: float = COOL_DOWN_S
    at_most: int = 0
    per_s: float = 0.0
    mode: Mode | None = None
    text: str = ""
    place: str = ""


def repeats(call: ActionCall) -> bool:
    """Return whether an action goes on until the condition is false."""
    return call.kind == "publish" and call.arguments.get("how") == "repeated"


def essence(reaction: Reaction) -> Reaction:
    """Return a reaction without its locations: two with the same content are equal."""
    found: Reaction = _placeless(reaction)
    return found


def _placeless(value: Any) -> Any:
    if isinstance(value, tuple):
        return tuple(map(_placeless, value))
    if not isinstance(value, msgspec.Struct):
        return value
    changes = {name: _placeless(getattr(value, name)) for name in value.__struct_fields__}
    if "place" in changes:
        changes["place"] = ""
    return msgspec.structs.replace(value, **changes)


class Because(msgspec.Struct, frozen=True, omit_defaults=True):
    """One thing that made a condition true.

    Attributes:
        entity: text form of the id of what it is about.
        statement: the condition's statement in words.
        state: that was held of it.
        since: seconds on the monitor's clock since which it was; the instant itself where that is not known.
        value: that was judged; None where there is none.
        quantity: key of the signal; empty where none was judged.
        expectation: id of the constraint; empty where none was judged.
        evidence: what shows it, in words.
    """

    entity: str
    statement: str
    state: str
    since: float
    value: float | None = None
    quantity: str = ""
    expectation: str = ""
    evidence: str = ""


class Decision(msgspec.Struct, frozen=True, omit_defaults=True):
    """A due action. Gates decide whether it is carried out.

    Attributes:
        id: unique within a run of the monitor: ``<reaction>/<number of the chain>.<step>``.
        reaction: name of the reaction.
        entity: text form of the id that the pattern bound, or of the entity that ``when`` is about first.
        step: of the chain, from 0.
        action: with its templates filled.
        at_s: seconds on the monitor's clock.
        because: what made the condition true, sorted.
        first_cause: text form of the id of the entity that is to blame; empty where nothing that is bad is.
        since: seconds on the monitor's clock at which the condition became true.
        mode: of the reaction.
        text: message for the operator, templates filled.
        place: ``file:line:column`` of the action.
    """

    id: str
    reaction: str
    entity: str
    step: int
    action: ActionCall
    at_s: float
    because: tuple[Because, ...] = ()
    first_cause: str = ""
    since: float = 0.0
    mode: Mode | None = None
    text: str = ""
    place: str = ""


class Result(str, Enum):
    """What became of a decision.

    - done: the action was carried out
    - refused: a gate or an agent said no; the chain ends until its condition was false
    - failed: it was tried and did not work; the next step follows if the condition is still true
    - held: everything is on hold; the chain ends until its condition was false
    - dry-run: nothing was done; the chain goes on as if it had been
    - asked: somebody was asked; another outcome follows
    - gave-up: there were too many restarts; the next step follows if the condition is still true
    """

    DONE = "done"
    REFUSED = "refused"
    FAILED = "failed"
    HELD = "held"
    DRY_RUN = "dry-run"
    ASKED = "asked"
    GAVE_UP = "gave-up"


class Outcome(msgspec.Struct, frozen=True, omit_defaults=True):
    """What became of a decision, in words, and how many seconds it took."""

    result: Result
    text: str = ""
    duration_s: float = 0.0


class Verification(str, Enum):
    """Whether what an action was to take away is gone."""

    GONE = "gone"
    STILL_THERE = "still there"
    UNKNOWN = "unknown"


class Checked(msgspec.Struct, frozen=True, omit_defaults=True):
    """The result of a decision: ``at_s`` is when it was observed, ``text`` describes it."""

    decision: str
    verification: Verification
    at_s: float
    text: str = ""
