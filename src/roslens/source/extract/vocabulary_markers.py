"""The vocabulary of interactive markers of ROS 1: what a server of them tells and hears (interactive_markers)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from roslens.model.graph import Role
from roslens.source.extract.abstract_value import Handle, Obj, Unknown, as_text
from roslens.source.extract.record import endpoint
from roslens.source.extract.text import Text
from roslens.source.extract.vocabulary import Called, outer

if TYPE_CHECKING:
    from roslens.source.extract.evaluation import Evaluation

_ENDS = (
    ("/update_full", "InteractiveMarkerInit", Role.PUBLISHER, True),
    ("/update", "InteractiveMarkerUpdate", Role.PUBLISHER, False),
    ("/feedback", "InteractiveMarkerFeedback", Role.SUBSCRIPTION, False),
)


@outer(
    "interactive_markers.InteractiveMarkerServer",
    "interactive_markers.interactive_marker_server.InteractiveMarkerServer",
)
def server(engine: Evaluation, _thing: Any, called: Called) -> Any:
    """A server of interactive markers; that of ROS 2 is another one, of which nothing is said."""
    found = Obj("interactive_markers.InteractiveMarkerServer")
    name = called.argument(0, "topic_ns")
    if engine.node.generation == "ros1" and name is not None and not isinstance(name, Handle | Obj | Unknown):
        for end, kind, role, latched in _ENDS:
            written = Text.of(as_text(name), end)
            endpoint(
                engine, Handle(engine.node), called, role, written, f"visualization_msgs::{kind}", queue=100,
                latched=latched,
            )  # fmt: skip
    return found
