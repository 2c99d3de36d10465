"""The vocabulary of roscpp: node handles, topics, services, parameters, timers, nodelets."""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import (
    Callable,
    Handle,
    Named,
    NodeBuilder,
    Obj,
    Unknown,
    Value,
    as_text,
)
from roslens.source.extract.domain.earlier_values import else_before
from roslens.source.extract.domain.kinds import first_of_kind, is_whole, name_of
from roslens.source.extract.interpreter.language_calls import BINDS
from roslens.source.extract.interpreter.vocabulary import CallSite, below, method, node_of, outer
from roslens.source.extract.ir.program import Call, Name
from roslens.source.extract.overlays.language.command_words import given_to_ros
from roslens.source.extract.overlays.ros.emit import endpoint, is_set, parameter, timer, type_of_callback
from roslens.source.extract.overlays.ros.emit_write import write_parameter
from roslens.source.extract.overlays.ros.vocabulary_shared import follow_visitors
from roslens.source.extract.symbolic.reason import NamePart, OfHandle, OfNode, OfParameter, RandomEnd
from roslens.source.extract.symbolic.text import Hole, Text, unknown
from roslens.source.extract.transfer.overload_choice import taking_so_many

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_OPTIONS = ("ros.SubscribeOptions", "ros.AdvertiseOptions", "ros.AdvertiseServiceOptions")


@outer("ros.init", "rospy.init_node")
def init(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The process becomes a node."""
    node = ctx.emitter.node
    name = called.argument(0 if called.name.startswith("rospy") else 2, "name")
    node.generation = "ros1"
    node.named = True
    if called.name == "ros.init":
        given_to_ros(ctx, called)
    node.name = as_text(name) if name is not None else Text((Hole(OfNode(NamePart.NAME)),))
    anonymous = called.argument(5, "anonymous")
    if anonymous is True or name_of(called.argument(3)).endswith("AnonymousName"):
        node.name = Text.of(node.name, "_", Hole(RandomEnd()))
    return None


@outer("ros.NodeHandle", "ros.NodeHandlePtr")
def handle(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Something names are resolved against: a namespace of the node."""
    return _handle(ctx, called)


def _handle(ctx: Context, called: CallSite) -> Handle:
    ctx.emitter.node.generation = "ros1"
    prefix = Text()
    node: NodeBuilder = ctx.emitter.node
    for place, value in enumerate(called.arguments[:2]):
        match value:
            case Handle():
                node, prefix = value.node, value.prefix
            case Text():
                prefix = below(Handle(node, prefix), _trimmed(value))
            case Unknown() | Obj() | Named():
                # A copy of a handle that somebody gives, or a text: who gives it knows the namespace.
                given = unknown(OfHandle(as_text(value).holes[0].reason))
                prefix = below(Handle(node, prefix), given) if place else given
    return Handle(node, prefix)


def _trimmed(name: Text) -> Text:
    """Return a namespace without ``/`` at its end."""
    if len(name.tail) > 1 and name.tail.endswith("/"):
        return Text((*name.parts[:-1], name.tail.rstrip("/")))
    return name


@method("nodelet.Nodelet", "getNodeHandle", "getMTNodeHandle")
@method("node", "getNodeHandle", "getMTNodeHandle", anywhere=True)
def public_handle(ctx: Context, _thing: Value, _called: CallSite) -> Value:
    """The namespace of the node."""
    return Handle(ctx.emitter.node)


@method("nodelet.Nodelet", "getPrivateNodeHandle", "getMTPrivateNodeHandle")
@method("node", "getPrivateNodeHandle", "getMTPrivateNodeHandle", anywhere=True)
def private_handle(ctx: Context, _thing: Value, _called: CallSite) -> Value:
    """The private namespace of the node."""
    return Handle(ctx.emitter.node, Text.of("~"))


@method("nodelet.Nodelet", "getName")
def nodelet_name(ctx: Context, _thing: Value, _called: CallSite) -> Value:
    """The name of the nodelet."""
    return Text((Hole(OfNode(NamePart.NAME), default=ctx.emitter.node.name.usual),))


@outer("nodelet.Nodelet")
def nodelet(ctx: Context, thing: Value, _called: CallSite) -> Value:
    """A nodelet is constructed."""
    ctx.emitter.node.generation = "ros1"
    ctx.emitter.node.kind = "nodelet"
    match thing:
        case Obj():
            thing.node = ctx.emitter.node
    return thing


def queue_of(value: Value) -> int:
    """Return the size of a queue; -1 where it is not known."""
    return value if is_whole(value) else -1


@method("handle", "advertise", anywhere=True)
def advertise(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A publisher."""
    handle = called.given(Handle, 0)
    if handle is not None:
        # A message of any type gets the handle to use: ``shape_shifter.advertise(node, topic, 10)``.
        thing = handle
        called = msgspec.structs.replace(called, arguments=called.arguments[1:], written=called.written[1:])
    kind = called.templates[0] if called.templates else Unknown("its type")
    options = called.given(Obj, 0)
    if options is not None and options.type in _OPTIONS:
        return _by_options(ctx, thing, called, Role.PUBLISHER, options)
    latched = called.argument(2) is True or called.argument(4) is True
    follow_visitors(ctx, called, 2)
    return endpoint(
        ctx, thing, called, Role.PUBLISHER, called.argument(0), kind, queue=queue_of(called.argument(1)),
        latched=latched,
    )  # fmt: skip


@method("handle", "subscribe", anywhere=True)
def subscribe(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A subscription."""
    options = called.given(Obj, 0)
    if options is not None and options.type in _OPTIONS:
        return _by_options(ctx, thing, called, Role.SUBSCRIPTION, options)
    match thing:
        case Handle():
            pass
        case _ if _is_function(called) or (not called.templates and len(called.arguments) < 2):
            return Unknown("result of subscribe()")
    callback = _callback(ctx, called, 2, takes=1)
    written = called.templates[0] if called.templates else type_of_callback(callback)
    kind: Value = written or Unknown("the parameter type of its callback")
    return endpoint(
        ctx, thing, called, Role.SUBSCRIPTION, called.argument(0), kind, queue=queue_of(called.argument(1)),
        callback=callback,
    )  # fmt: skip


def _is_function(called: CallSite) -> bool:
    """Return whether a call is given a function first, where a handle takes a name: another library subscribes so."""
    match called.written[:1]:
        case (Call(function=Name(name=name)),) if name in BINDS:
            return True
    match called.argument(0):
        case Callable():
            return True
    return False


def _callback(ctx: Context, called: CallSite, place: int, takes: int = 0) -> Value:
    """Return a callback, bound to the object that is given after it; of several of its name the one that takes so many.

    A callback of a topic takes one message, that of a service a request and a response.
    """
    callback = called.given(Callable, place)
    thing = called.given(Obj, place + 1)
    if callback is None:
        return called.argument(place)
    if takes and not callback.arguments:
        callback = taking_so_many(ctx.index, callback, takes)
    if callback.function.class_name and thing is not None:
        return Callable(callback.function, callback.path, thing, callback.names, callback.arguments)
    return callback


@method("handle", "advertiseService", anywhere=True)
def advertise_service(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A server of a service."""
    options = called.given(Obj, 0)
    if options is not None and options.type in _OPTIONS:
        return _by_options(ctx, thing, called, Role.SERVICE_SERVER, options)
    callback = _callback(ctx, called, 1, takes=2)
    written = called.templates[0] if called.templates else type_of_callback(callback)
    kind: Value = written or Unknown("the parameter type of its callback")
    return endpoint(ctx, thing, called, Role.SERVICE_SERVER, called.argument(0), kind, callback=callback)


@method("handle", "serviceClient", anywhere=True)
def service_client(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A client of a service."""
    kind = called.templates[0] if called.templates else Unknown("its type")
    return endpoint(ctx, thing, called, Role.SERVICE_CLIENT, called.argument(0), kind)


@outer("ros.service.call", "ros.service.createClient")
def call_once(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A service is called by its name."""
    kind = called.templates[0] if called.templates else _declared_type(ctx, called)
    return endpoint(ctx, Handle(ctx.emitter.node), called, Role.SERVICE_CLIENT, called.argument(0), kind)


def _declared_type(ctx: Context, called: CallSite) -> Value:
    """Return the type of the request, or of what holds request and response."""
    value = called.argument(1)
    del ctx
    match value:
        case Obj() | Named():
            return value
    return Unknown("its type")


@outer("ros.topic.waitForMessage", "rospy.wait_for_message")
def wait_for_message(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A topic is subscribed to for one message."""
    kind = called.templates[0] if called.templates else called.argument(1, "topic_type")
    endpoint(ctx, Handle(ctx.emitter.node), called, Role.SUBSCRIPTION, called.argument(0, "topic"), kind)
    return Unknown("a message")


_TYPES = {"bool": "bool", "int": "int", "double": "double", "float": "double", "std::string": "string"}
"""Types of roscpp's parameters by the template argument that asks for them."""


@method("handle", "param", "getParam", "getParamCached", "param_cached")
def read(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A parameter is read, into a variable where one is given."""
    default = called.argument(2) if called.name == "param" and len(called.arguments) > 2 else None
    if called.name == "param" and len(called.arguments) == 2:
        default = called.argument(1)
    # What is said in the code decides, not the type of the default: `param<bool>("x", x, "false")` reads a bool.
    kind = _TYPES.get(called.templates[0], "") if called.templates else ""
    value = parameter(
        ctx, thing, called, "read", called.argument(0), default=default, given=default is not None, kind=kind
    )
    if len(called.written) > 1 and not (called.name == "param" and len(called.arguments) == 2):
        test = is_set(value)
        ctx.assign(called.written[1], value if default is not None else else_before(value, called.argument(1)))
        return Unknown("whether the parameter is set", test)
    return value


@outer("ros.param.param", "ros.param.get", "ros.param.getCached")
def read_by_name(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A parameter is read by its name."""
    named = "param" if called.name.endswith(".param") else "getParam"
    inner = CallSite(named, called.arguments, called.keywords, called.templates, called.written, called.evidence)
    return read(ctx, Handle(ctx.emitter.node), inner)


@method("handle", "setParam")
def write(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A parameter is written."""
    write_parameter(ctx, thing, called, called.argument(0), called.argument(1))
    return None


@outer("ros.param.set")
def write_by_name(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A parameter is written by its name."""
    return write(ctx, Handle(ctx.emitter.node), called)


@outer("ros.spin", "rospy.spin", "ros.waitForShutdown")
def spin(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The node runs until it is shut down; what is written after it is no part of that."""
    ctx.callbacks.running = True
    return Unknown(f"result of {called.name}()")


@method("handle", "searchParam")
def search(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A parameter is looked for in the namespaces above too."""
    name = as_text(called.argument(0))
    if len(called.written) > 1:
        ctx.assign(called.written[1], Text((Hole(f"the key at which {name} is found", default=name.usual),)))
    return Unknown("whether the parameter is found")


@method("handle", "hasParam", quiet=True)
def has(ctx: Context, thing: Value, called: CallSite) -> Value:
    """Whether a parameter is set."""
    return _has(ctx, thing, called)


@outer("ros.param.has", "rospy.has_param", quiet=True)
def has_by_name(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Whether a parameter is set, by its name."""
    return _has(ctx, Handle(ctx.emitter.node), called)


def _has(ctx: Context, thing: Value, called: CallSite) -> Unknown:
    name = below(thing, as_text(called.argument(0)))
    known = name.known or name.pattern
    test = is_set(Text((Hole(OfParameter(str(name)), known),))) if node_of(ctx, thing) is ctx.emitter.node else None
    return Unknown(f"whether the parameter {name} is set", test)


@method("handle", "deleteParam", "ok", "shutdown", quiet=True)
def ask(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Something is asked that only a run can answer."""
    return Unknown(f"result of {called.name}()")


@method("handle", "getNamespace", "resolveName", "getUnresolvedNamespace")
def namespace(ctx: Context, thing: Value, called: CallSite) -> Value:
    """The namespace of a handle, or a name below it."""
    if called.name == "resolveName":
        return below(thing, as_text(called.argument(0)))
    match thing:
        case Handle(prefix=prefix) if prefix.parts:
            return prefix
    del ctx
    return Text((Hole(OfNode(NamePart.NAMESPACE), default=""),))


@outer("ros.this_node.getName", "rospy.get_name")
def own_name(_ctx: Context, _thing: Value, _called: CallSite) -> Value:
    """The full name of the node."""
    return Text((Hole(OfNode(NamePart.FULL_NAME), default="~"),))


@outer("ros.this_node.getNamespace", "rospy.get_namespace")
def own_namespace(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The namespace of the node; that of rospy ends with ``/``."""
    space = Hole(OfNode(NamePart.NAMESPACE), default="/")
    return Text.of(space, "/") if called.name.startswith("rospy") else Text((space,))


@outer("ros.names.resolve", "rospy.resolve_name", "ros.names.remap")
def resolve(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A name is resolved: it stays what it is."""
    return as_text(called.argument(len(called.arguments) - 1))


@method("handle", "createTimer", "createWallTimer", "createSteadyTimer", anywhere=True)
def create_timer(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A timer."""
    timer(ctx, thing, called, called.argument(0), _callback(ctx, called, 1), None)
    return Obj("ros.Timer")


def here(ctx: Context) -> Handle:
    """Return the node that is built, which is one of ROS 1."""
    ctx.emitter.node.generation = "ros1"
    return Handle(ctx.emitter.node)


def _by_options(ctx: Context, thing: Value, called: CallSite, role: Role, options: Obj) -> Value:
    fields = options.fields
    name = fields.get("topic", fields.get("service", Unknown("a name that is not set in the options")))
    return endpoint(
        ctx, thing, called, role, name, fields.get("-type", Unknown("its type")),
        queue=queue_of(fields.get("queue_size")), latched=fields.get("latch") is True, callback=fields.get("-callback"),
    )  # fmt: skip


@outer(*_OPTIONS, *(f"{name}.create" for name in _OPTIONS))
def endpoint_options(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """Options of an endpoint: name, size of the queue and callback in one; of a service it has no queue."""
    found = Obj(called.name.removesuffix(".create"))
    if called.name.endswith(".create") or called.arguments:
        return fill_options(ctx, found, called)
    return found


def fill_options(_ctx: Context, thing: Obj, called: CallSite) -> Value:
    """Let options hold what they are made of, or what ``init`` gives them."""
    service = thing.type.endswith("ServiceOptions")
    thing.fields["service" if service else "topic"] = as_text(called.argument(0))
    if not service:
        thing.fields["queue_size"] = called.argument(1)
    callback = first_of_kind(called.arguments, Callable)
    thing.fields["-callback"] = callback
    thing.fields["latch"] = thing.type == "ros.AdvertiseOptions" and called.argument(6) is True
    # Callbacks of a publisher learn who connects; its type is a text: name, size, checksum, type, definition.
    by_callback = "" if thing.type == "ros.AdvertiseOptions" else type_of_callback(callback)
    kind = called.templates[0] if called.templates else by_callback
    thing.fields["-type"] = kind or Unknown("its type")
    return thing


for _name in _OPTIONS:
    method(_name, "init", "initByFullCallbackType")(fill_options)


__all__ = ["node_of"]
