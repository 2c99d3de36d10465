"""The vocabulary of interactive markers: what a server of them publishes and subscribes to (interactive_markers)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.domain.abstract_value import Handle, Obj, QosValue, Value
from roslens.source.extract.domain.kinds import all_of_kind, first_of_kind
from roslens.source.extract.interpreter.vocabulary import CallSite, node_of, outer
from roslens.source.extract.overlays.ros.emit import endpoint
from roslens.source.extract.overlays.ros.vocabulary_shared import handle_of
from roslens.source.extract.symbolic.text import Text

if TYPE_CHECKING:
    from roslens.source.extract.transfer.context import Context

_QUEUE = 100
_ENDS = (
    ("/update_full", "InteractiveMarkerInit", Role.PUBLISHER, True),
    ("/update", "InteractiveMarkerUpdate", Role.PUBLISHER, False),
    ("/feedback", "InteractiveMarkerFeedback", Role.SUBSCRIPTION, False),
)


@outer(
    "interactive_markers.InteractiveMarkerServer",
    "interactive_markers.interactive_marker_server.InteractiveMarkerServer",
)
def server(ctx: Context, _thing: Value, called: CallSite) -> Value:
    """A server of interactive markers; in ROS 2 all that exist are asked for by a service."""
    found = Obj("interactive_markers.InteractiveMarkerServer")
    name = first_of_kind((*called.arguments, called.keywords.get("topic_ns")), Text)
    if name is not None:
        handle = handle_of(ctx, called)
        if node_of(ctx, handle).generation == "ros2":
            _server_of_ros2(ctx, handle, called, name)
        else:
            for end, kind, role, latched in _ENDS:
                endpoint(
                    ctx, Handle(ctx.emitter.node), called, role, Text.of(name, end),
                    f"visualization_msgs::{kind}", queue=_QUEUE, latched=latched,
                )  # fmt: skip
    return found


def _server_of_ros2(ctx: Context, handle: Value, called: CallSite, name: Text) -> None:
    given = all_of_kind(called.arguments, QosValue)
    update = given[0] if given else _keeping(_QUEUE)
    feedback = given[1] if len(given) > 1 else _keeping(_QUEUE if called.evidence.path.endswith(".py") else 1)
    for end, kind, role, quality in (
        ("/update", "msg::InteractiveMarkerUpdate", Role.PUBLISHER, update),
        ("/feedback", "msg::InteractiveMarkerFeedback", Role.SUBSCRIPTION, feedback),
        ("/get_interactive_markers", "srv::GetInteractiveMarkers", Role.SERVICE_SERVER, None),
    ):
        endpoint(ctx, handle, called, role, Text.of(name, end), f"visualization_msgs::{kind}", qos=quality)


def _keeping(depth: int) -> QosValue:
    return QosValue(Qos("reliable", "volatile", "keep_last", depth))
