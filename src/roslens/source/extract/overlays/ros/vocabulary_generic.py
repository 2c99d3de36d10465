"""The vocabulary of generic endpoints of rclcpp, whose type is a text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Unknown, Value
from roslens.source.extract.domain.quality import quality_of
from roslens.source.extract.interpreter.vocabulary import CallSite, method
from roslens.source.extract.overlays.ros.emit import endpoint
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


@method("node", "create_generic_publisher", anywhere=True)
def publisher(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A publisher of serialized messages."""
    quality = quality_of(called.argument(2))
    return endpoint(ctx, thing, called, Role.PUBLISHER, called.argument(0), _kind(called), qos=quality)


@method("node", "create_generic_subscription", anywhere=True)
def subscription(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A subscription to serialized messages."""
    quality, callback = quality_of(called.argument(2)), called.argument(3)
    name = called.argument(0)
    return endpoint(ctx, thing, called, Role.SUBSCRIPTION, name, _kind(called), qos=quality, callback=callback)


@method("node", "create_generic_client", anywhere=True)
def client(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A client of a service with any type."""
    return endpoint(ctx, thing, called, Role.SERVICE_CLIENT, called.argument(0), _kind(called))


@method("node", "create_generic_service", anywhere=True)
def service(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A server of a service with any type."""
    name, callback = called.argument(0), called.argument(2)
    return endpoint(ctx, thing, called, Role.SERVICE_SERVER, name, _kind(called), callback=callback)


def _kind(called: CallSite) -> Value:
    kind = called.argument(1)
    match kind:
        case Text(known=str(known)) if known:
            return known.replace("/", "::")
        case Text():
            return Unknown(str(kind))
    return kind
