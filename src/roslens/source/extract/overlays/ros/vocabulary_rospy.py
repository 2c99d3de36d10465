"""The vocabulary of rospy: topics, services, parameters, timers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Obj, Value
from roslens.source.extract.interpreter.vocabulary import CallSite, outer
from roslens.source.extract.overlays.ros.emit import endpoint, parameter, timer
from roslens.source.extract.overlays.ros.emit_write import write_parameter
from roslens.source.extract.overlays.ros.vocabulary_ros1 import here, queue_of

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context


@outer("rospy.Publisher")
def py_publisher(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A publisher of rospy."""
    return endpoint(
        ctx, here(ctx), called, Role.PUBLISHER, called.argument(0, "name"), called.argument(1, "data_class"),
        queue=queue_of(called.argument(6, "queue_size")), latched=called.argument(4, "latch") is True,
    )  # fmt: skip


@outer("rospy.Subscriber")
def py_subscriber(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A subscription of rospy."""
    return endpoint(
        ctx, here(ctx), called, Role.SUBSCRIPTION, called.argument(0, "name"), called.argument(1, "data_class"),
        queue=queue_of(called.argument(4, "queue_size")), callback=called.argument(2, "callback"),
    )  # fmt: skip


@outer("rospy.Service")
def py_service(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A server of a service of rospy."""
    return endpoint(
        ctx, here(ctx), called, Role.SERVICE_SERVER, called.argument(0, "name"),
        called.argument(1, "service_class"), callback=called.argument(2, "handler"),
    )  # fmt: skip


@outer("rospy.ServiceProxy")
def py_service_proxy(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A client of a service of rospy."""
    return endpoint(
        ctx, here(ctx), called, Role.SERVICE_CLIENT, called.argument(0, "name"),
        called.argument(1, "service_class"),
    )  # fmt: skip


@outer("rospy.get_param", "rospy.get_param_cached")
def py_read(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A parameter is read by rospy."""
    given = len(called.arguments) > 1 or "default" in called.keywords
    return parameter(
        ctx, here(ctx), called, "read", called.argument(0, "param_name"), default=called.argument(1, "default"),
        given=given,
    )  # fmt: skip


@outer("rospy.set_param")
def py_write(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A parameter is written by rospy."""
    value = called.argument(1, "param_value")
    write_parameter(ctx, here(ctx), called, called.argument(0, "param_name"), value)
    return None


@outer("rospy.Timer")
def py_timer(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A timer of rospy."""
    timer(ctx, here(ctx), called, called.argument(0, "period"), called.argument(1, "callback"), None)
    return Obj("rospy.Timer")
