"""The vocabulary of image_transport, of both generations.

In ROS 2 all take ``rmw_qos_profile_default`` where no profile is given, with the size of the queue that they are given
as its depth (``image_transport/image_transport.hpp`` and ``image_transport.cpp``).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import msgspec

from roslens.model.graph import Role
from roslens.source.extract.domain.abstract_value import Callable, Handle, Named, Obj, QosValue, Unknown, Value
from roslens.source.extract.domain.kinds import all_of_kind, first_of_kind
from roslens.source.extract.domain.quality import DEFAULT_QUALITY, quality_of
from roslens.source.extract.interpreter.vocabulary import CallSite, method, node_of, outer
from roslens.source.extract.overlays.ros.emit import endpoint
from roslens.source.extract.overlays.ros.vocabulary_ros2 import free_function
from roslens.source.extract.overlays.ros.vocabulary_shared import follow_visitors, handle_of
from roslens.source.extract.symbolic.text import Hole, Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_IMAGE = "sensor_msgs::msg::Image"
_CAMERA = "sensor_msgs::msg::CameraInfo"


@outer("image_transport.ImageTransport")
def images(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """What images are published and subscribed to with."""
    return Obj("image_transport.ImageTransport", None, {"handle": handle_of(ctx, called)})


def _handle(thing: Value, ctx: Context) -> Value:
    match thing:
        case Obj():
            return thing.fields.get("handle")
    return Handle(ctx.emitter.node)


@method("image_transport.ImageTransport", "advertise", "advertiseCamera")
def image_publisher(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A publisher of images, and with a camera of what is known of it."""
    handle, size = _handle(thing, ctx), _size(called)
    follow_visitors(ctx, called, 2)
    name, qos = called.argument(0), _quality(called)
    made = endpoint(ctx, handle, called, Role.PUBLISHER, name, _IMAGE, queue=size, qos=qos)
    if called.name.endswith("Camera"):
        endpoint(ctx, handle, called, Role.PUBLISHER, _camera(name), _CAMERA, queue=size, qos=qos)
    return made


@method("image_transport.ImageTransport", "subscribe", "subscribeCamera")
def image_subscription(ctx: Context, thing: Value, called: CallSite) -> Value:
    """A subscription to images, and with a camera to what is known of it."""
    handle, size = _handle(thing, ctx), _size(called)
    name, callback, qos = called.argument(0), called.argument(2), _quality(called)
    made = endpoint(ctx, handle, called, Role.SUBSCRIPTION, name, _IMAGE, queue=size, callback=callback, qos=qos)
    if called.name.endswith("Camera"):
        endpoint(ctx, handle, called, Role.SUBSCRIPTION, _camera(name), _CAMERA, queue=size, qos=qos)
    return made


@outer("image_transport.create_camera_publisher", "image_transport.create_camera_subscription")
def camera(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """An image with what is known of its camera, in ROS 2."""
    role = Role.PUBLISHER if called.name.lower().endswith("publisher") else Role.SUBSCRIPTION
    callback = first_of_kind(called.arguments, Callable)
    node, name = called.argument(0), called.argument(1)
    given = called.argument(2 if role is Role.PUBLISHER else 4, default=Named("rmw_qos_profile_default"))
    qos = quality_of(given)
    made = endpoint(ctx, node, called, role, name, _IMAGE, callback=callback, qos=qos)
    endpoint(ctx, node, called, role, _camera(name), _CAMERA, qos=qos)
    return made


@outer("image_transport.CameraPublisher", "image_transport.CameraSubscriber", "image_transport.Publisher",
       "image_transport.Subscriber")  # fmt: skip
def made_at_once(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """What ROS 2 also makes by constructors, of a node and a topic; others hold what is made later, or copy."""
    if len(called.arguments) < 2:
        return Unknown(called.name)
    kind = called.name.rpartition(".")[2]
    if kind.startswith("Camera"):
        return camera(ctx, _thing, called)
    made = "create_publisher" if kind == "Publisher" else "create_subscription"
    return free_function(ctx, _thing, msgspec.structs.replace(called, name=f"image_transport.{made}"))


@outer("camera_info_manager.CameraInfoManager")
def camera_manager(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """What keeps what is known of a camera: it is set by a service.

    Where that is follows the handle in ROS 1. In ROS 2 it is below a namespace, which is that of the node in releases
    before there was an argument for it (camera_info_manager.cpp of the package ``camera_info_manager``).
    """
    handle = handle_of(ctx, called)
    name = Text.of("set_camera_info")
    if node_of(ctx, handle).generation == "ros2":
        texts = all_of_kind(called.arguments, Text)
        release = Hole("release of camera_info_manager", default="~")
        name = Text.of(texts[2] if len(texts) > 2 else release, "/", name)
    endpoint(ctx, handle, called, Role.SERVICE_SERVER, name, "sensor_msgs::srv::SetCameraInfo")
    return Obj("camera_info_manager.CameraInfoManager")


@outer("image_transport.getCameraInfoTopic")
def camera_topic(_ctx: Context, _thing: Value, called: CallSite) -> Value:
    """The topic of what is known of a camera, beside that of its images."""
    return _camera(called.argument(0))


@outer("image_transport.SubscriberFilter")
def filtered_images(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A subscription to images that are filtered; without arguments it is made by ``subscribe`` later."""
    found = Obj("image_transport.SubscriberFilter")
    if called.arguments:
        filtered_images_later(ctx, found, called)
    return found


@method("image_transport.SubscriberFilter", "subscribe")
def filtered_images_later(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A filtered subscription to images is made: ``subscribe(node, topic, transport)``, in ROS 1 of a transport."""
    first = called.argument(0)
    match first:
        case Obj(node=None):
            given = _handle(first, ctx)
        case _:
            given = first
    qos = DEFAULT_QUALITY if len(called.arguments) < 4 else quality_of(called.argument(3))
    return endpoint(ctx, given, called, Role.SUBSCRIPTION, called.argument(1), _IMAGE, qos=qos)


def _quality(called: CallSite) -> QosValue | None:
    """Return the quality of service of what an object makes: a profile, or the default one with a queue."""
    return quality_of(called.argument(1))


def _size(called: CallSite) -> int:
    """Return how many images are kept at most; -1 where that is unknown."""
    size = called.given(int, 1)
    return -1 if size is None else size


def _camera(image: Value) -> Value:
    """Return the topic of the camera's information beside a topic of images."""
    match image:
        case Text(tail=last) if last and ("/" in last or len(image.parts) == 1):
            folder, slash, _ = last.rpartition("/")
            return Text.of(*image.before, f"{folder}{slash}camera_info")
    return Unknown("the topic next to that of the image")
