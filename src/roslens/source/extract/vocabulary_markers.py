"""The vocabulary of servers of interactive markers, of both generations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roslens.model.graph import Role
from roslens.model.qos import Qos
from roslens.source.extract.abstract_value import Obj, QosValue, Unknown
from roslens.source.extract.record import endpoint
from roslens.source.extract.text import Text, unknown
from roslens.source.extract.vocabulary import Called, node_of, outer
from roslens.source.extract.vocabulary_shared import handle_of

if TYPE_CHECKING:
    from roslens.source.extract.evaluation import Evaluation

_MESSAGES = "visualization_msgs::msg::InteractiveMarker"
_QUEUE = 100


@outer("interactive_markers.InteractiveMarkerServer",
       "interactive_markers.interactive_marker_server.InteractiveMarkerServer")  # fmt: skip
def markers(engine: Evaluation, _thing: Any, called: Called) -> Any:
    """A server of interactive markers: below its name it tells of them, and is told what is done to them.

    All that exists is asked for by a service in ROS 2, and told by a latched topic in ROS 1 (both servers of
    the package ``interactive_markers``).
    """
    handle = handle_of(engine, called)
    texts = [one for one in called.arguments if isinstance(one, Text)]
    name = texts[0] if texts else called.keywords.get("topic_ns", called.keywords.get("namespace"))
    below = (
        name if isinstance(name, Text) else unknown(name.reason if isinstance(name, Unknown) else "the markers' name")
    )
    python, ros1 = called.evidence.path.endswith(".py"), node_of(engine, handle).generation == "ros1"
    given = [one for one in called.arguments if isinstance(one, QosValue)]
    update = given[0] if given else _keeping(_QUEUE)
    feedback = given[1] if len(given) > 1 else _keeping(_QUEUE if python else 1)

    def make(role: Role, last: str, kind: str, qos: QosValue | None = None, *, latched: bool = False) -> None:
        topic = Text.of(below, "/", last)
        queue = _QUEUE if ros1 else -1
        endpoint(engine, handle, called, role, topic, kind, qos=qos, queue=queue, latched=latched)

    make(Role.PUBLISHER, "update", f"{_MESSAGES}Update", update)
    if ros1:
        make(Role.PUBLISHER, "update_full", f"{_MESSAGES}Init", latched=True)
    make(Role.SUBSCRIPTION, "feedback", f"{_MESSAGES}Feedback", feedback)
    if not ros1:
        make(Role.SERVICE_SERVER, "get_interactive_markers", "visualization_msgs::srv::GetInteractiveMarkers")
    return Obj("interactive_markers.InteractiveMarkerServer")


def _keeping(depth: int) -> QosValue:
    return QosValue(Qos("reliable", "volatile", "keep_last", depth))
