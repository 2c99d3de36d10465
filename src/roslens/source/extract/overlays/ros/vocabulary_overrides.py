"""The vocabulary of what parameters may set of a quality of service, of rclcpp and rclpy (QosOverridingOptions)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Named, Obj, Unknown, Value, as_text
from roslens.source.extract.domain.kinds import all_of_kind
from roslens.source.extract.facts.node_facts import Overrides
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_CPP, _PYTHON = "rclcpp.QosOverridingOptions", "rclpy.qos_overriding_options.QoSOverridingOptions"
_USUAL = ("history", "depth", "reliability")
_POLICIES = {
    name.replace("_", ""): name
    for name in ("avoid_ros_namespace_conventions", "deadline", "depth", "durability", "history", "lifespan",
                 "liveliness", "liveliness_lease_duration", "reliability")
}  # fmt: skip
_FIELD = "qos_overriding_options"


@outer("rclcpp.PublisherOptions", "rclcpp.SubscriptionOptions", "rclcpp.PublisherOptionsWithAllocator",
       "rclcpp.SubscriptionOptionsWithAllocator", quiet=True)  # fmt: skip
def of_endpoint(_ctx: Context, thing: Value, called: CallSite) -> Value:
    """Options of an endpoint: those of a copy, or none yet."""
    given = called.argument(0)
    held = dict(given.fields) if isinstance(given, Obj) and given.type == called.name else {}
    if isinstance(thing, Obj):
        thing.fields.update(held)
        return thing
    return Obj(called.name, None, held)


@outer(_CPP, _PYTHON, quiet=True)
def chosen(ctx: Context, _thing: Value, called: CallSite) -> Overrides:
    """The policies that parameters may set, by their kinds."""
    kinds = called.argument(0, "policy_kinds")
    match kinds:
        case list() if kinds and isinstance(kinds[0], list):
            # ``QosOverridingOptions({{…}, callback, id})``
            kinds, *rest = kinds
        case _:
            rest = [*called.arguments[1:]]
    if isinstance(kinds, Named):
        # ``QosOverridingOptions{Depth, History}``
        kinds, rest = all_of_kind(called.arguments, Named), []
    if isinstance(kinds, Overrides):
        return kinds
    return _overrides(ctx, called, kinds if kinds is not None else [], rest)


@outer(f"{_CPP}.with_default_policies", f"{_PYTHON}.with_default_policies", quiet=True)
def usual(ctx: Context, _thing: Value, called: CallSite) -> Overrides:
    """History, depth and reliability may be set by parameters."""
    return _overrides(ctx, called, None, called.arguments)


def _overrides(ctx: Context, called: CallSite, kinds: Value, rest: list[Value]) -> Overrides:
    """Return overrides of policies by their kinds (None means the usual ones), with an id where one is given."""
    ctx.summaries.touch()
    given = called.keywords.get("entity_id", rest[1] if len(rest) > 1 else None)
    number = "" if given is None else as_text(given).known
    names = list(_USUAL) if kinds is None else _names(kinds)
    unknown = "" if names is not None and number is not None else f"which it may set is not known ({called.name})"
    return Overrides(tuple(names or ()), number or "", unknown, tuple(dict.fromkeys(ctx.state.conditions)))


def _names(kinds: Value) -> list[str] | None:
    if not isinstance(kinds, list):
        return None
    words = [one.name.rpartition(".")[2].replace("_", "").lower() if isinstance(one, Named) else "" for one in kinds]
    return [_POLICIES[one] for one in words] if all(one in _POLICIES for one in words) else None


def overrides_of(called: CallSite) -> Overrides | None:
    """Return what parameters may set of the endpoint that a call makes; None where they may set nothing."""
    given = called.keywords.get(_FIELD)
    for one in called.arguments:
        if given is None and isinstance(one, Obj):
            given = one.fields.get(_FIELD)
    if isinstance(given, list):
        names = _names(given)
        given = Overrides(tuple(names), "") if names is not None else Unknown(_FIELD)
    if isinstance(given, Unknown | Text):
        return Overrides((), "", "which policies it may set is not known")
    return given if isinstance(given, Overrides) else None
