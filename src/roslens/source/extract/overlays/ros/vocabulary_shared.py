"""The vocabulary of libraries of both generations: transforms, filters of messages, actions, diagnostics."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.domain.abstract_value import Callable, Handle, Made, Obj, QosValue, Unknown, Value
from roslens.source.extract.domain.kinds import all_of_kind, first_of_kind, is_whole, items_of, node_in
from roslens.source.extract.domain.quality import DEFAULT_QUALITY, quality_of
from roslens.source.extract.interpreter.vocabulary import CallSite, method, node_of, outer
from roslens.source.extract.overlays.ros.emit import endpoint, is_guessed, sure_of
from roslens.source.extract.symbolic.reason import RandomEnd
from roslens.source.extract.symbolic.text import Hole, Text, Written

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_TF = "tf2_msgs::msg::TFMessage"
_DYNAMIC = QosValue(Qos("reliable", "volatile", "keep_last", 100))
_STATIC = QosValue(Qos("reliable", "transient_local", "keep_last", 1))


def handle_of(ctx: Context, called: CallSite) -> Value:
    """Return the first argument that stands for a node; in ROS 2 an unknown one where none is known to."""
    given = (*called.arguments, *called.keywords.values())
    for value in given:
        if node_in(value) is not None:
            return value
    if ctx.emitter.node.generation == "ros2" and given and is_guessed(given[0]):
        return given[0]
    return Handle(ctx.emitter.node)


def follow_visitors(ctx: Context, called: CallSite, first: int) -> None:
    """Follow what a publisher of ROS 1 calls when a subscriber connects or disconnects: arguments from ``first`` on."""
    for one in called.arguments[first:]:
        ctx.callbacks.give(one, Written("a subscriber connects"))


@outer("tf2_ros.TransformListener", "tf.TransformListener", "tf2_ros.transform_listener.TransformListener")
def listener(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A listener to transforms."""
    node = _listening(ctx, called)
    static = msgspec.structs.replace(_STATIC.qos, depth=100)
    topic, static_topic = (
        called.keywords.get(name, Text.of(f"/{name[:-6]}")) for name in ("tf_topic", "tf_static_topic")
    )
    endpoint(ctx, node, called, Role.SUBSCRIPTION, topic, _TF, qos=_DYNAMIC)
    endpoint(ctx, node, called, Role.SUBSCRIPTION, static_topic, _TF, qos=QosValue(static))
    return Obj(called.name)


def _listening(ctx: Context, called: CallSite) -> Value:
    """Return the node that listens: in C++ of ROS 2 one of its own where none is given (transform_listener.cpp)."""
    given = [one for one in called.arguments if node_in(one) is not None]
    if given or ctx.emitter.node.generation != "ros2" or called.evidence.path.endswith(".py"):
        return Handle(node_of(ctx, handle_of(ctx, called)))
    perhaps = [one for one in called.arguments[1:] if is_guessed(one)]
    if perhaps:
        return perhaps[0]
    name = Text.of("transform_listener_impl_", Hole(RandomEnd()))
    words = (Text.of("--ros-args"), Text.of("-r"), Text.of("__node:=", name))
    return Handle(ctx.emitter.further(called.evidence, ctx.state.conditions, name, words))


@outer("tf2_ros.TransformBroadcaster", "tf.TransformBroadcaster", "tf2_ros.transform_broadcaster.TransformBroadcaster")
def broadcaster(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A broadcaster of transforms."""
    node = handle_of(ctx, called)
    endpoint(ctx, node, called, Role.PUBLISHER, Text.of("/tf"), _TF, qos=_DYNAMIC, queue=100)
    return Obj(called.name)


@outer("tf2_ros.StaticTransformBroadcaster",
       "tf2_ros.static_transform_broadcaster.StaticTransformBroadcaster")  # fmt: skip
def static_broadcaster(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A broadcaster of transforms that stay."""
    node = handle_of(ctx, called)
    endpoint(ctx, node, called, Role.PUBLISHER, Text.of("/tf_static"), _TF, qos=_STATIC, queue=100, latched=True)
    return Obj(called.name)


@outer("message_filters.Subscriber")
def filtered(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A subscription whose messages are filtered; without arguments it is made by ``subscribe`` later.

    Where no quality of service is given it is that of a queue of ten messages (``message_filters/subscriber.h``:
    ``rmw_qos_profile_default``; ``message_filters/__init__.py``: ``kwargs.setdefault('qos_profile', 10)``).
    """
    found = Obj("message_filters.Subscriber", None, {"templates": list(called.templates)})
    if called.arguments or called.keywords:
        _filtered(ctx, found, called)
    return found


def _may_be_type(value: Value) -> bool:
    match value:
        case None | Text() | Handle() | Obj() | int():
            return False
    return True


def _filtered(ctx: Context, found: Obj, called: CallSite) -> None:
    templates = items_of(found.fields.get("templates"))
    names = all_of_kind(called.arguments, Text)
    python = called.evidence.path.endswith(".py")
    name: Value
    kind: Value
    if python and not called.templates:
        # Subscriber(topic, type) of rospy, Subscriber(node, type, topic) of rclpy.
        kinds = [one for one in called.arguments if _may_be_type(one)]
        name, kind = names[0] if names else called.keywords.get("topic"), kinds[0] if kinds else Unknown("its type")
    else:
        name = names[0] if names else called.argument(1, default=Unknown("its name"))
        kind = templates[0] if templates else Unknown("its type")
    queue = next((one for one in called.arguments if is_whole(one)), -1)
    quality = _quality_of_filter(called, python=python)
    endpoint(ctx, handle_of(ctx, called), called, Role.SUBSCRIPTION, name, kind, qos=quality, queue=queue)


def _quality_of_filter(called: CallSite, *, python: bool) -> QosValue:
    """Return the quality of service behind the name of the topic, or by its keyword; the default where none is."""
    given = called.keywords.get("qos_profile", called.keywords.get("qos"))
    if given is None and not python:
        # C++ has a node, a topic and a quality of service in this order.
        given = called.argument(2)
    return DEFAULT_QUALITY if given is None else quality_of(given) or QosValue(Qos(), "what is given for it")


@method("message_filters.Subscriber", "subscribe")
def filtered_later(ctx: Context, thing: Obj, called: CallSite) -> Value:
    """A filtered subscription is made."""
    _filtered(ctx, thing, called)
    return None


@outer("actionlib.SimpleActionServer", "actionlib.ActionServer", "actionlib.simple_action_server.SimpleActionServer",
       "actionlib.action_server.ActionServer")  # fmt: skip
def action_server(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A server of an action of actionlib."""
    return _action(ctx, called, Role.ACTION_SERVER)


@outer("actionlib.SimpleActionClient", "actionlib.ActionClient", "actionlib.simple_action_client.SimpleActionClient",
       "actionlib.action_client.ActionClient")  # fmt: skip
def action_client(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A client of an action of actionlib."""
    return _action(ctx, called, Role.ACTION_CLIENT)


def _action(ctx: Context, called: CallSite, role: Role) -> Value:
    ctx.emitter.node.generation = "ros1"
    texts = all_of_kind(called.arguments, Text)
    name = texts[0] if texts else called.argument(0, "name", "ns")
    kind: Value = called.templates[0] if called.templates else called.argument(1, "ActionSpec")
    callback = first_of_kind((*called.arguments, *called.keywords.values()), Callable)
    return endpoint(ctx, handle_of(ctx, called), called, role, name, kind, callback=callback)


@outer("diagnostic_updater.Updater")
def updater(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A publisher of diagnostics."""
    node = handle_of(ctx, called)
    kind = "diagnostic_msgs::msg::DiagnosticArray"
    quality = QosValue(Qos("reliable", "volatile", "keep_last", 1))
    endpoint(ctx, node, called, Role.PUBLISHER, Text.of("/diagnostics"), kind, qos=quality, queue=1)
    return Obj("diagnostic_updater.Updater")


@method("made", "publish", "call", "async_call", "call_async", "async_send_request", "sendGoal", "async_send_goal",
        "send_goal", "send_goal_async", "publish_feedback")  # fmt: skip
def use(_ctx: Context, thing: Made, called: CallSite) -> Value:
    """A message is published, or a service or action called."""
    fact = thing.node.endpoints[thing.place]
    place = msgspec.structs.replace(called.evidence, how="written")
    if place not in fact.sites:
        thing.node.endpoints[thing.place] = msgspec.structs.replace(fact, sites=(*fact.sites, place))
    return Unknown(f"result of {called.name}()")


@method("made", "get_topic_name", "getTopic", "get_service_name", "getService")
def topic_of(_ctx: Context, thing: Made, _called: CallSite) -> Value:
    """The name of an endpoint."""
    return thing.node.endpoints[thing.place].name


__all__ = ["sure_of"]
