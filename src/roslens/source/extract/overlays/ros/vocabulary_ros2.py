"""The vocabulary of rclcpp and rclpy: nodes, endpoints, timers, quality of service."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Callable, Group, Handle, Named, Obj, Unknown, Value, as_text
from roslens.source.extract.domain.kinds import all_of_kind, first_of_kind, has_kind, is_number, name_of, object_of
from roslens.source.extract.domain.plain_methods import is_namespace
from roslens.source.extract.interpreter.vocabulary import CallSite, method, node_of, outer
from roslens.source.extract.overlays.ros.emit import endpoint, timer, type_of_callback
from roslens.source.extract.overlays.ros.vocabulary_options import doubt_options, given_options, take_options
from roslens.source.extract.overlays.ros.vocabulary_overrides import overrides_of
from roslens.source.extract.overlays.ros.vocabulary_qos import given_quality
from roslens.source.extract.symbolic.reason import NamePart, OfNode
from roslens.source.extract.symbolic.text import Hole, Text, unknown

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_NODES = ("rclcpp.Node", "rclpy.node.Node", "rclpy.create_node", "rclcpp.Node.make_shared", "rclpy.Node")
_LIFECYCLE = ("rclcpp_lifecycle.LifecycleNode", "rclpy.lifecycle.LifecycleNode", "rclpy.lifecycle.Node",
              "rclpy.lifecycle.node.LifecycleNode")  # fmt: skip


@outer(*_NODES)
def node(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A node is made, or a class that is one is constructed."""
    return _node(ctx, thing, called, "node")


@outer(*_LIFECYCLE)
def lifecycle_node(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A managed node."""
    return _node(ctx, thing, called, "lifecycle")


def _node(ctx: Context, thing: Value, called: CallSite, kind: str) -> Value:
    building, itself = ctx.emitter.node, object_of(thing)
    if building.named and (itself is None or itself.node is None):
        building = ctx.emitter.further(called.evidence, ctx.state.conditions)
    building.named = True
    building.conditions = tuple(dict.fromkeys(ctx.state.conditions))
    building.generation = "ros2"
    building.kind = kind if building.kind == "node" else building.kind
    name = called.argument(0, "node_name", "name")
    building.name = as_text(name) if name is not None else Text((Hole(OfNode(NamePart.NAME)),))
    namespace = called.argument(1, "namespace")
    match namespace:
        case Text():
            building.namespace = namespace
        case Unknown() if len(called.arguments) > 2 or "namespace" in called.keywords:
            building.namespace = unknown(namespace.reason)
    given = given_options(called)
    if given is not None:
        take_options(ctx, building, given, called)
    else:
        doubt_options(building, called)
    itself = itself or Obj("rclcpp.Node", None, {})
    itself.node = building
    return itself


def _group(called: CallSite, *places: int) -> Value:
    for value in (*(called.argument(place) for place in places), *called.keywords.values()):
        match value:
            case Group():
                return value
            case Obj() if (group := value.held("callback_group", Group)) is not None:
                return group
    return None


def _python(called: CallSite) -> bool:
    return called.evidence.path.endswith(".py") or (not called.templates and _is_type(called.argument(0, "msg_type")))


def _is_type(value: Value) -> bool:
    return "." in name_of(value)


@method("node", "create_publisher", "create_lifecycle_publisher", anywhere=True)
def publisher(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A publisher."""
    if not called.templates and _python(called):
        name, kind, place = called.argument(1, "topic"), called.argument(0, "msg_type"), 2
    else:
        name, kind, place = called.argument(0), called.templates[0] if called.templates else Unknown("its type"), 1
    qos = given_quality(ctx, called, place, called.argument(place, "qos_profile"))
    return endpoint(ctx, thing, called, Role.PUBLISHER, name, kind, qos=qos, overrides=overrides_of(called))


@method("node", "create_subscription", anywhere=True)
def subscription(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A subscription."""
    if not called.templates and _python(called):
        name, kind = called.argument(1, "topic"), called.argument(0, "msg_type")
        callback, place = called.argument(2, "callback"), 3
    else:
        # An older form has the callback first.
        place = 2 if called.given(Callable, 1) is not None else 1
        name, callback = called.argument(0), called.argument(3 - place)
        kind = called.templates[0] if called.templates else type_of_callback(callback) or Unknown("its type")
    qos = given_quality(ctx, called, place, called.argument(place, "qos_profile"))
    return endpoint(
        ctx, thing, called, Role.SUBSCRIPTION, name, kind, qos=qos, callback=callback,
        group=_group(called, 3, 4), overrides=overrides_of(called),
    )  # fmt: skip


@method("node", "create_service", anywhere=True)
def service(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A server of a service."""
    if not called.templates and _python(called):
        name, kind, callback = (
            called.argument(1, "srv_name"),
            called.argument(0, "srv_type"),
            called.argument(2, "callback"),
        )
    else:
        name, callback = called.argument(0), called.argument(1)
        kind = called.templates[0] if called.templates else type_of_callback(callback) or Unknown("its type")
    return endpoint(ctx, thing, called, Role.SERVICE_SERVER, name, kind, callback=callback, group=_group(called, 3))


@method("node", "create_client", anywhere=True)
def client(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A client of a service."""
    if not called.templates and _python(called):
        name, kind = called.argument(1, "srv_name"), called.argument(0, "srv_type")
    else:
        name, kind = called.argument(0), called.templates[0] if called.templates else Unknown("its type")
    return endpoint(ctx, thing, called, Role.SERVICE_CLIENT, name, kind, group=_group(called, 2))


@outer("rclcpp.create_publisher", "rclcpp.create_subscription", "rclcpp.create_service", "rclcpp.create_client",
       "rclcpp.create_timer", "rclcpp.create_wall_timer", "image_transport.create_publisher",
       "image_transport.create_subscription")  # fmt: skip
def free_function(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A function that makes an endpoint of the node it is given first."""
    name = called.name.rpartition(".")[2]
    templates = called.templates or ("sensor_msgs::msg::Image",) * called.name.startswith("image_transport")
    first = 1
    # Some take the interfaces of a node one by one; what is a text is the name then.
    texts = has_kind(called.arguments, Text)
    while first < len(called.arguments) and _is_interface(called.arguments[first], perhaps=texts):
        first += 1
    inner = msgspec.structs.replace(
        called, name=name, arguments=called.arguments[first:], templates=templates, written=called.written[first:]
    )
    if called.name.startswith("image_transport"):
        given, place = inner.arguments, 3 if name == "create_subscription" else 1
        qos = given[place] if len(given) > place else Named("rmw_qos_profile_default")
        inner = msgspec.structs.replace(inner, arguments=[*given[:1], qos, *given[1:2][: place - 1]], written=())
    words = {"create_publisher": publisher, "create_subscription": subscription, "create_service": service,
             "create_client": client}  # fmt: skip
    word = words.get(name, wall_timer)
    return word(ctx, called.argument(0), inner)


@outer("rclcpp_action.create_server", "rclpy.action.ActionServer", "rclpy.action.server.ActionServer")
def action_server(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A server of an action."""
    return _action(ctx, called, Role.ACTION_SERVER)


@outer("rclcpp_action.create_client", "rclpy.action.ActionClient", "rclpy.action.client.ActionClient")
def action_client(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A client of an action."""
    return _action(ctx, called, Role.ACTION_CLIENT)


def _action(ctx: Context, called: CallSite, role: Role) -> Value:
    name: Value
    kind: Value
    if called.templates:
        texts = all_of_kind(called.arguments, Text)
        name, kind = texts[0] if texts else called.argument(1), called.templates[0]
    else:
        name, kind = called.argument(2, "action_name"), called.argument(1, "action_type")
    callbacks = all_of_kind((*called.arguments, *called.keywords.values()), Callable)
    for one in callbacks[1:]:
        ctx.callbacks.give(one)
    return endpoint(
        ctx, called.argument(0, "node"), called, role, name, kind, callback=callbacks[0] if callbacks else None,
        group=_group(called, 5, 6),
    )  # fmt: skip


def _is_interface(value: Value, *, perhaps: bool) -> bool:
    """Whether an argument stands for a node or a part of it; one of which nothing is known ``perhaps`` does."""
    match value:
        case Obj() | Handle():
            return True
        case Unknown():
            return perhaps
    return False


@method("node", "create_wall_timer", "create_timer", "create_ros_timer", anywhere=True)
def wall_timer(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A timer."""
    given = called.arguments
    callback = first_of_kind((*given, *called.keywords.values()), Callable)
    period = next(filter(is_number, given), called.keywords.get("timer_period_sec"))
    timer(ctx, thing, called, period, callback, _group(called, 2))
    return Obj("rclcpp.TimerBase")


@method("node", "create_callback_group", anywhere=True)
def callback_group(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A callback group, named after where it is made."""
    del ctx
    kind = called.given(Named, 0)
    word = "group" if kind is None else kind.name.rpartition(".")[2]
    return Group(f"{word}:{called.evidence.line}")


@outer("rclpy.callback_groups.ReentrantCallbackGroup", "rclpy.callback_groups.MutuallyExclusiveCallbackGroup")
def python_group(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A callback group of rclpy."""
    return Group(f"{called.name.rpartition('.')[2].removesuffix('CallbackGroup')}:{called.evidence.line}")


@method("node", "create_sub_node")
def sub_node(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A node below another one: its names begin with the namespace."""
    name = as_text(called.argument(0))
    match thing:
        case Handle(prefix=before) if before.parts:
            name = Text.of(before, "/", name)
    return Handle(node_of(ctx, thing), name)


@method("node", "get_node_base_interface", "get_node_topics_interface", "get_node_services_interface",
        "get_node_parameters_interface", "get_node_clock_interface", "get_node_logging_interface",
        "get_node_waitables_interface", "get_node_graph_interface", "get_node_timers_interface", "shared_from_this",
        "weak_from_this", "lock", "get")  # fmt: skip
def interface(ctx: Context, thing: Value, _called: CallSite) -> Value:
    """A part of a node stands for the node."""
    match thing:
        case Obj() | Handle():
            return thing
    return Handle(ctx.emitter.node)


@method("node", "get_name", "get_fully_qualified_name", "get_effective_namespace", "get_namespace")
def own_name(ctx: Context, thing: Value, called: CallSite) -> Value:
    """The name of the node, which may be given to it from outside."""
    node_ = node_of(ctx, thing)
    if "namespace" in called.name:
        return Text((Hole(node_.of_name(NamePart.NAMESPACE), default=""),))
    if "fully" in called.name:
        return Text((Hole(node_.of_name(NamePart.FULL_NAME), default="~"),))
    return Text((Hole(node_.of_name(NamePart.NAME), default=node_.name.usual),))


@method("node", "resolve_topic_or_service_name", "resolve_topic_name", "resolve_service_name")
def resolved(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A name is resolved: what is relative is below the namespace of the node, where it is remapped."""
    node_ = node_of(ctx, thing)
    name = as_text(called.argument(0, "topic", "service"))
    return _expanded(name, node_.of_name(NamePart.NAMESPACE), node_.of_name(NamePart.FULL_NAME))


@outer("rclcpp.expand_topic_or_service_name")
def expanded(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A name is expanded below the namespace that is given."""
    space = as_text(called.argument(2))
    match space.only:
        case Hole(reason=OfNode() as of) as first if is_namespace(first):
            return _expanded(as_text(called.argument(0)), of, OfNode(NamePart.FULL_NAME, of.node))
    return Unknown("an expanded name")


def _expanded(name: Text, space: OfNode, whole: OfNode) -> Text:
    match name.parts:
        case (Hole() as first, *rest):
            return name if is_namespace(first) else Text((msgspec.structs.replace(first, below=space), *rest))
    if name.head.startswith("~"):
        return Text.of(Hole(whole, default="~"), name.head[1:], *name.behind)
    return name if name.head.startswith("/") else Text.of(Hole(space, default=""), "/", name)
