"""Publishes for the monitor in ROS 1, without rospy: diagnostics and rated signals."""

from __future__ import annotations

from typing import Any

import msgspec

from roslens.live.adapters.ros1.publisher_updates import Answer
from roslens.live.adapters.ros1.wire.definition import known_definitions
from roslens.live.adapters.ros1.wire.topic_server import Published, TopicServer
from roslens.model.acting.outgoing import Outgoing

DIAGNOSTICS = "/diagnostics"
_ARRAY = "diagnostic_msgs/DiagnosticArray"
_RATED = "roslens_msgs/RatedSignals"


class MonitorPublisher:
    """The publishers of one node.

    Attributes:
        publications: topics with the types of their messages, to be registered.
    """

    def __init__(self, address: str, own: str, caller: str, *, diagnostics: bool, rated: str) -> None:
        """Publish on /diagnostics if ``diagnostics`` is set, and on the topic ``rated`` unless it is empty.

        Args:
            address: to listen at, empty for all of this host.
            own: by which others reach that address.
            caller: our own name.
            diagnostics: whether to publish them.
            rated: topic of rated signals.

        Raises:
            OSError: the address cannot be listened on.
        """
        definitions = known_definitions()
        types = {**({DIAGNOSTICS: _ARRAY} if diagnostics else {}), **({rated: _RATED} if rated else {})}
        self.publications = tuple(types.items())
        self._own = own
        self._rated = rated
        self._sequence = 0
        self._pack = {type_: definitions.packer(type_) for type_ in types.values()}
        self._server = TopicServer(
            address,
            caller,
            {
                topic: Published(type_, definitions.md5(type_), definitions.whole_text(type_))
                for topic, type_ in types.items()
            },
        )

    @property
    def answers(self) -> dict[str, Answer]:
        """What a publisher answers to the calls of others, by method."""
        return {"requestTopic": self._request, "getPublications": self._list}

    def _request(self, arguments: list[Any]) -> list[Any]:
        if len(arguments) != 3 or not isinstance(arguments[2], list):
            return [-1, "expected caller, topic and a list of protocols", 0]
        if not any(topic == arguments[1] for topic, _ in self.publications):
            return [-1, f"{str(arguments[1])[:200]!r} is not published here", 0]
        if not any(isinstance(one, list) and one[:1] == ["TCPROS"] for one in arguments[2]):
            return [0, "only TCPROS is spoken here", []]
        return [1, "", ["TCPROS", self._own, self._server.port]]

    def _list(self, _: list[Any]) -> list[Any]:
        return [1, "", [list(pair) for pair in self.publications]]

    def publish(self, frame: Outgoing) -> None:
        """Publish what a frame holds."""
        self._sequence += 1
        header = (self._sequence % 2**32, frame.time, "")
        if frame.statuses is not None and _ARRAY in self._pack:
            statuses = [msgspec.structs.astuple(one) for one in frame.statuses]
            self._server.publish(DIAGNOSTICS, self._pack[_ARRAY]((header, statuses)))
        if frame.rated is not None and _RATED in self._pack:
            rated = frame.rated
            signals = [msgspec.structs.astuple(one) for one in rated.signals]
            connections = [msgspec.structs.astuple(one) for one in rated.connections]
            values = (header, rated.monitor, rated.complete, rated.part, rated.parts, signals, connections)
            self._server.publish(self._rated, self._pack[_RATED](values))

    def close(self) -> None:
        """Publish no more."""
        self._server.close()
