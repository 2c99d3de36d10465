"""The vocabulary of what parameters may set of a quality of service, of rclcpp and rclpy (QosOverridingOptions)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.source.extract.domain.abstract_value import Named, Obj, Unknown, Value, as_text
from roslens.source.extract.domain.kinds import all_of_kind, fields_of, name_of
from roslens.source.extract.facts.node_facts import Overrides
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.overlays.ros.vocabulary_options import made_on
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
    given = called.given(Obj, 0)
    held = dict(given.fields) if given is not None and given.type == called.name else {}
    return made_on(thing, Obj(called.name, None, held))


@outer(_CPP, _PYTHON, quiet=True)
def chosen(ctx: Context, _thing: Value, called: CallSite) -> Overrides:
    """The policies that parameters may set, by their kinds."""
    kinds = called.argument(0, "policy_kinds")
    match kinds:
        case Overrides():
            return kinds
        case Named():
            # ``QosOverridingOptions{Depth, History}``
            return _overrides(ctx, called, [*all_of_kind(called.arguments, Named)], [])
        case list([list(first), *rest]):
            # ``QosOverridingOptions({{…}, callback, id})``
            return _overrides(ctx, called, first, rest)
    return _overrides(ctx, called, kinds if kinds is not None else [], [*called.arguments[1:]])


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
    unknown = "" if names is not None and number is not None else f"it is unknown which ones it may set ({called.name})"
    return Overrides(tuple(names or ()), number or "", unknown, tuple(dict.fromkeys(ctx.state.conditions)))


def _names(kinds: Value) -> list[str] | None:
    match kinds:
        case list():
            words = [name_of(one).rpartition(".")[2].replace("_", "").lower() for one in kinds]
            return [_POLICIES[one] for one in words] if all(one in _POLICIES for one in words) else None
    return None


def overrides_of(called: CallSite) -> Overrides | None:
    """Return what parameters may set of the endpoint that a call makes; None where they may set nothing."""
    given = called.keywords.get(_FIELD)
    for one in called.arguments:
        if given is None:
            given = fields_of(one).get(_FIELD)
    names = _names(given)
    match given:
        case Overrides():
            return given
        case list() if names is not None:
            return Overrides(tuple(names), "")
        case list() | Unknown() | Text():
            return Overrides((), "", "it is unknown which policies it may set")
    return None
