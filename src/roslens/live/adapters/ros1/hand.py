"""Acts in ROS 1 without rospy: publishers are registered before they are needed, so that subscribers are connected."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from roslens.live.act.keeping import Keeping
from roslens.live.act.ros import ActionError
from roslens.live.adapters.ros1.master import Master
from roslens.live.adapters.ros1.pattern_subscriber import PatternSubscriber
from roslens.live.adapters.ros1.publisher_updates import Answer
from roslens.live.adapters.ros1.resolve import Resolver
from roslens.live.adapters.ros1.wire.message_form import MessageForms
from roslens.live.adapters.ros1.wire.service_call import call_service
from roslens.live.adapters.ros1.wire.topic_server import Published, TopicServer
from roslens.live.adapters.ros1.wire.xml_rpc import Caller, CallError, unwrap

FOLLOW_S = 1.0
_MEET_S = 1.0
"""How long a message waits for the first subscriber, where the master knows of one."""
_LOOK_S = 0.01
_ROSOUT, _LOG = "/rosout", "rosgraph_msgs/Log"
_LEVELS = {"info": 2, "warning": 4, "error": 8}


class Ros1Hand:
    """Publishes, calls and sets for the monitor; for many threads.

    Attributes:
        generation: 1.
    """

    generation = 1

    def __init__(
        self, master_uri: str, caller: str, resolver: Resolver, forms: MessageForms, *, address: str, own: str,
        wall: Callable[[], float] = time.time,
    ) -> None:  # fmt: skip
        """Act as the node ``caller``, at ``address`` (empty for all of this host), which others reach as ``own``.

        Raises:
            OSError: the address cannot be listened on.
        """
        self.api = ""
        self._uri = master_uri
        self._caller = caller
        self._resolver = resolver
        self._forms = forms
        self._own = own
        self._wall = wall
        self._lock = threading.RLock()
        self._topics: dict[str, Published] = {}
        self._server = TopicServer(address, caller, self._topics)
        self._kept: dict[tuple[tuple[str, ...], float], Keeping] = {}
        self._hearing: list[PatternSubscriber] = []
        self._master_pid = 0
        self._ended = threading.Event()

    @property
    def answers(self) -> dict[str, Answer]:
        """What a publisher answers to the calls of others, by method."""
        return {"requestTopic": self._request, "getPublications": self._list}

    def follow(self) -> None:
        """Register again whenever the master is another one, until :meth:`close`."""
        master = self._master(FOLLOW_S)
        while not self._ended.is_set():
            with suppress(CallError):
                pid = master.pid()
                if self._master_pid and pid != self._master_pid:
                    for topic, published in list(self._topics.items()):
                        master.publish(topic, published.type, self.api)
                self._master_pid = pid
            self._ended.wait(FOLLOW_S)
        master.close()

    def advertise(self, topic: str, type_: str, fields: Mapping[str, Any], *, latched: bool) -> None:
        """Register as a publisher.

        Raises:
            ActionError: the type is not known here, a field does not fit, or the master does not register it.
        """
        full = self._forms.name(type_)
        self._forms.packed(full, fields, self._now())
        package, _, name = full.split("/")
        with self._lock:
            reported = self._topics.get(topic)
            if reported is not None:
                if reported.type != f"{package}/{name}":
                    raise ActionError(
                        f"{topic} is published with {reported.type} already", expected=f"{package}/{name}"
                    )
                return
            md5, text = self._forms.sum_and_text(type_)
            self._topics[topic] = Published(f"{package}/{name}", md5, text, latched)
            try:
                self._with_master(lambda master: master.publish(topic, f"{package}/{name}", self.api), _MEET_S)
            except ActionError:
                del self._topics[topic]
                raise

    def publish(self, topic: str, type_: str, fields: Mapping[str, Any], *, latched: bool) -> int:
        """Publish, and return how many subscribers are connected.

        Raises:
            ActionError: the type is not known here, a field does not fit, or the master does not register it.
        """
        self.advertise(topic, type_, fields, latched=latched)
        body = self._forms.packed(self._forms.name(type_), fields, self._now())
        end = time.monotonic() + _MEET_S
        if not latched and not self._server.subscribers(topic) and self._is_subscribed(topic):
            while not self._server.subscribers(topic) and time.monotonic() < end:
                time.sleep(_LOOK_S)
        self._server.publish(topic, body)
        return self._server.subscribers(topic)

    def meet(self, service: str, type_: str, fields: Mapping[str, Any]) -> None:
        """Look whether the type is known here and the fields fit.

        Raises:
            ActionError: they do not.
        """
        if not service.startswith("/"):
            raise ActionError(f"the service {service[:80]!r}", expected="a name that begins with /")
        self._forms.packed(self._forms.service(type_)[0], fields, self._now())

    def call(self, service: str, type_: str, fields: Mapping[str, Any], timeout_s: float) -> Mapping[str, Any]:
        """Call a service.

        Raises:
            ActionError: nobody offers it or answers in time, or it failed there.
        """
        request, response = self._forms.service(type_)
        body = self._forms.packed(request, fields, self._now())
        uri = self._asked("lookupService", service, timeout_s=timeout_s)
        answer = call_service(str(uri), service, self._caller, body, self._resolver, timeout_s)
        return self._forms.unpacked(response, answer)

    def set_parameter(self, node: str, name: str, value: Any, timeout_s: float) -> None:
        """Set a parameter at the parameter server.

        Raises:
            ActionError: the master does not take it.
        """
        key = name if name.startswith("/") else f"{node}/{name}"
        self._asked("setParam", key, list(value) if isinstance(value, tuple) else value, timeout_s=timeout_s)

    def ready_to_log(self) -> None:
        """Register as a publisher of /rosout.

        Raises:
            ActionError: the master does not register it.
        """
        self.advertise(_ROSOUT, _LOG, {}, latched=False)

    def log(self, level: str, text: str) -> None:
        """Publish a text on /rosout.

        Raises:
            ActionError: the master does not register it.
        """
        fields = {"level": _LEVELS[level], "name": self._caller, "msg": text, "file": "", "function": ""}
        self.publish(_ROSOUT, _LOG, fields, latched=False)

    def record(self, patterns: tuple[str, ...], before_s: float, path: str, after_s: float) -> str:
        """Keep what is said on some topics, and write it once there is a path; see ``live/act/ros.py``.

        Raises:
            ActionError: a pattern is none, or the recording cannot be written.
        """
        with self._lock:
            keeping = self._kept.get((patterns, before_s))
            if keeping is None:
                keeping = self._kept[patterns, before_s] = Keeping(before_s)
                self._hearing.append(
                    PatternSubscriber(self._uri, self._caller, self._resolver, patterns, keeping.received)
                )
        return keeping.write(path, "ros1", after_s) if path else "kept from now on"

    def close(self) -> None:
        """Take the registrations back and publish no more."""
        self._ended.set()
        for one in self._hearing:
            one.close()
        master = self._master(0.5)
        with suppress(CallError):
            for topic in self._topics:
                master.unpublish(topic, self.api)
        master.close()
        self._server.close()

    def _is_subscribed(self, topic: str) -> bool:
        try:
            return any(
                reported == topic for reported, _ in self._with_master(lambda one: one.state()[0], _MEET_S).subscribers
            )
        except ActionError:
            return False

    def _master(self, wait_s: float) -> Master:
        return Master(self._uri, self._caller, self._resolver, wait_s)

    def _with_master(self, ask: Callable[[Master], Any], wait_s: float) -> Any:
        # A line of its own: orders are carried out in threads of their own, and a line is for one.
        master = self._master(wait_s)
        try:
            return ask(master)
        except CallError as error:
            raise ActionError(f"the ROS master does not do it: {error}") from None
        finally:
            master.close()

    def _asked(self, method: str, *arguments: Any, timeout_s: float) -> Any:
        line = Caller(self._uri, self._resolver, timeout_s)
        try:
            return unwrap(line.call(method, self._caller, *arguments), method)
        except CallError as error:
            raise ActionError(str(error)) from None
        finally:
            line.close()

    def _request(self, arguments: list[Any]) -> list[Any]:
        if len(arguments) != 3 or not isinstance(arguments[2], list):
            return [-1, "expected caller, topic and a list of protocols", 0]
        if arguments[1] not in self._topics:
            return [-1, f"{str(arguments[1])[:200]!r} is not published here", 0]
        if not any(isinstance(one, list) and one[:1] == ["TCPROS"] for one in arguments[2]):
            return [0, "only TCPROS is spoken here", []]
        return [1, "", ["TCPROS", self._own, self._server.port]]

    def _list(self, _: list[Any]) -> list[Any]:
        return [1, "", [[topic, published.type] for topic, published in self._topics.items()]]

    def _now(self) -> tuple[int, int]:
        whole, part = divmod(round(self._wall() * 1e9), 1_000_000_000)
        return whole, part
