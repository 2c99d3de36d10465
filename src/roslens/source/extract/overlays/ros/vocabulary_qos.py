"""The vocabulary of quality of service of rclcpp and rclpy."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.model.qos import Qos
from roslens.source.extract.domain.abstract_value import Named, Obj, QosValue, Unknown, Value
from roslens.source.extract.domain.quality import (
    DEFAULT_QUALITY,
    DURATIONS,
    INITIALISATION,
    POLICIES,
    PRESETS,
    changed,
    history_of,
    keeping,
    profile_of,
    quality_by_key,
    quality_of,
)
from roslens.source.extract.interpreter.vocabulary import CallSite, expression_of, method, outer
from roslens.source.extract.symbolic.text import Hole, Text
from roslens.source.extract.symbols.declared_type import is_number

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_NO_DEPTH = QosValue(msgspec.structs.replace(DEFAULT_QUALITY.qos, depth=0))


@outer("rclcpp.QoS", "rclpy.qos.QoSProfile", quiet=True)
def qos(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A quality of service."""
    # What is made is an object of its own, whatever it is made of.
    return _made_on(thing, msgspec.structs.replace(_from_words(ctx, called)))


def _made_on(thing: Value, value: QosValue) -> Value:
    """Return the object that a constructor is evaluated on, which holds what it makes; that where there is none."""
    match thing:
        case Obj():
            thing.fields["qos"] = value
            return thing
    return value


def _from_words(ctx: Context, called: CallSite) -> QosValue:
    first = called.argument(0, "depth", "history_depth")
    match first:
        case list([history, depth]):
            first = Obj(INITIALISATION, None, {"qos": history_of(history, depth)})
        case list():
            first = Unknown("a list")
    base = _given(ctx, first, called)
    for name, value in called.keywords.items():
        if name in POLICIES or name in DURATIONS:
            base = changed(base, name, value)
    return base


def _given(ctx: Context, first: Value, called: CallSite) -> QosValue:
    """Return the profile from the first argument, which is a depth, a history, or another quality of service."""
    match first:
        case Obj() if first.type == INITIALISATION:
            profile = DEFAULT_QUALITY
            if len(called.arguments) > 1:
                profile = quality_of(called.argument(1)) or QosValue(Qos(), "a profile of the middleware")
            return keeping(profile, _held(first))
        case Unknown(reason=why) if _is_depth(ctx, called, 0):
            return _of_depth(str(why))
        case Text():
            return _of_depth(str(first))
        case Named() if quality_of(first) is None:
            return _of_depth(f"the value of {first.name}")
    return quality_of(first) or _NO_DEPTH


def given_quality(ctx: Context, called: CallSite, place: int, value: Value) -> QosValue | None:
    """Return the quality of service that an endpoint is given; what is a number by its declaration is a depth.

    Args:
        ctx: of the evaluation.
        called: that makes the endpoint.
        place: of the argument.
        value: of it.
    """
    match value:
        case Text(holes=(Hole(parameter=str(parameter)), *_)) if parameter:
            # No parameter has a quality of service for its value.
            return _of_depth(str(value))
        case Unknown(reason=why) if ctx.dialect.types_convert and _is_number(ctx, called, place):
            return _of_depth(str(why))
    return quality_of(value)


def _is_depth(ctx: Context, called: CallSite, place: int) -> bool:
    """Whether an argument is a number by its declaration; else a quality of service may be copied."""
    # Those of rclpy have no copies: only their policies are given.
    return not ctx.dialect.types_convert or _is_number(ctx, called, place)


def _is_number(ctx: Context, called: CallSite, place: int) -> bool:
    written = expression_of(ctx, called, place)
    thing = ctx.state.frame.object
    function = ctx.stack.calls[-1][1] if ctx.stack.calls else None
    return written is not None and is_number(ctx.index, function, thing.defined if thing else None, written)


def _of_depth(reason: str) -> QosValue:
    """Return the usual quality of service with a depth that is unknown."""
    return QosValue(_NO_DEPTH.qos, f"its depth is {reason}")


def _held(thing: Obj) -> QosValue:
    """Return the quality of service that an object is made with."""
    return thing.held("qos", QosValue) or QosValue(Qos(), "a quality of service of another class")


@outer("rclpy.qos.QoSPresetProfiles.get_from_short_key")
def by_key(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A preset by the name that command lines have for it."""
    return quality_by_key(called.argument(0, "name"))


@outer("rmw_qos_profile_t")
def profile(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A profile of the middleware, by its members or empty."""
    return profile_of(called.arguments)


@outer("rclcpp.QoSInitialization")
def initialisation(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A history and the number of messages that it keeps."""
    return Obj(INITIALISATION, None, {"qos": history_of(called.argument(0), called.argument(1))})


@outer("rclcpp.KeepLast", "rclcpp.KeepAll", "rclcpp.QoSInitialization.from_rmw")
def keep(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """How many messages are kept."""
    first = called.argument(0)
    if called.name.endswith("from_rmw"):
        value = quality_of(first) or QosValue(Qos(), "a profile of the middleware")
    elif called.name.endswith("All"):
        value = QosValue(Qos(history="keep_all", depth=0))
    else:
        value = (quality_of(first) if first is not None else None) or QosValue(
            Qos(), "the number of messages that are kept"
        )
    return Obj(INITIALISATION, None, {"qos": keeping(DEFAULT_QUALITY, value)})


@outer(*(f"{module}.{name}" for module in ("rclcpp", "rclpy.qos", "rclcpp.qos") for name in PRESETS), quiet=True)
def preset(_ctx: Context, thing: Value, called: CallSite) -> Value:
    """A quality of service that has a name, with the history that it is given."""
    value = QosValue(PRESETS[called.name.rpartition(".")[2]])
    match called.argument(0):
        case None:
            pass
        case Obj() as history if history.type == INITIALISATION:
            value = keeping(value, _held(history))
        case _:
            value = QosValue(msgspec.structs.replace(value.qos, depth=0), "the number of messages that it keeps")
    return _made_on(thing, value)


@method("qos", "reliable", "best_effort", "transient_local", "durability_volatile", "keep_all", "keep_last",
        "reliability", "durability", "history", "liveliness", "deadline", "lifespan",
        "liveliness_lease_duration", "avoid_ros_namespace_conventions", "reliability_best_available",
        "durability_best_available", "get_rmw_qos_profile")  # fmt: skip
def refined(ctx: Context, thing: Obj | QosValue, called: CallSite) -> Value:
    """A quality of service with one policy changed."""
    match thing:
        case Obj():
            ctx.state.store.put(thing.fields, "qos", _refined(_held(thing), called))
            return thing
    return _refined(thing, called)


for _name in ("QoS", "rclcpp.QoS", "rclcpp.SensorDataQoS", "rclcpp.SystemDefaultsQoS", "rclcpp.ServicesQoS"):
    method(_name, "reliable", "best_effort", "transient_local", "durability_volatile", "keep_all", "keep_last",
           "reliability", "durability", "history", "deadline", "lifespan", "liveliness")(refined)  # fmt: skip


def _refined(base: QosValue, called: CallSite) -> QosValue:
    name, qos_ = called.name, base.qos
    fixed = {"reliable": {"reliability": "reliable"}, "best_effort": {"reliability": "best_effort"},
             "transient_local": {"durability": "transient_local"}, "durability_volatile": {"durability": "volatile"},
             "keep_all": {"history": "keep_all"}, "reliability_best_available": {"reliability": "best_available"},
             "durability_best_available": {"durability": "best_available"}}  # fmt: skip
    if name in fixed:
        return QosValue(msgspec.structs.replace(qos_, **fixed[name]), base.unknown)
    first = called.argument(0)
    if name == "keep_last" and first is not None:
        return changed(QosValue(msgspec.structs.replace(qos_, history="keep_last"), base.unknown), "depth", first)
    return changed(base, name, first) if first is not None else base
