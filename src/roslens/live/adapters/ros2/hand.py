"""Acts in ROS 2 with rclpy: publishers and clients are made before they are needed."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping
from typing import Any

from roslens.live.act.keeping import Keeping
from roslens.live.act.parameter_value import parameter_fields
from roslens.live.act.ros import ActionError
from roslens.live.adapters.ros2.fields import filled, interface, plain
from roslens.live.adapters.ros2.listening import Listening
from roslens.live.adapters.ros2.meeting import YOUNG_S, patience_s

_DEPTH = 10
_LOOK_S = 0.02
_SET = "rcl_interfaces/srv/SetParameters"


class Ros2Hand:
    """One node that publishes and calls for the monitor; for many threads.

    Attributes:
        generation: 2.
    """

    generation = 2

    def __init__(self, node: Any, wall: Callable[[], float] = time.time) -> None:
        """Act as ``node``, which another thread spins."""
        self._node = node
        self._wall = wall
        self._lock = threading.Lock()
        self._grown = time.monotonic() + YOUNG_S
        self._publishers: dict[tuple[str, str, bool], Any] = {}
        self._used: set[tuple[str, str]] = set()
        self._clients: dict[tuple[str, str], Any] = {}
        self._kept: dict[tuple[tuple[str, ...], float], Keeping] = {}
        self._listening: list[Listening] = []

    def advertise(self, topic: str, type_: str, fields: Mapping[str, Any], *, latched: bool) -> None:
        """Make a publisher.

        Raises:
            ActionError: the type is not known here, or a field does not fit.
        """
        filled(interface(type_, "msg"), fields, self._now())
        self._publisher(topic, type_, latched=latched)

    def publish(self, topic: str, type_: str, fields: Mapping[str, Any], *, latched: bool) -> int:
        """Publish, and return how many subscriptions there are.

        Raises:
            ActionError: the type is not known here, or a field does not fit.
        """
        message = filled(interface(type_, "msg"), fields, self._now())
        publisher = self._publisher(topic, type_, latched=latched)
        with self._lock:
            first = (topic, type_) not in self._used
            self._used.add((topic, type_))
        begun = time.monotonic()
        while not (count := publisher.get_subscription_count()) and not latched:
            known = bool(self._node.get_subscriptions_info_by_topic(topic))
            end = begun + patience_s(known=known, first=first)
            if time.monotonic() >= (end if known else max(end, self._grown)):
                break
            time.sleep(_LOOK_S)
        publisher.publish(message)
        return int(count)

    def meet(self, service: str, type_: str, fields: Mapping[str, Any]) -> None:
        """Make a client.

        Raises:
            ActionError: the type is not known here, or a field does not fit.
        """
        filled(interface(type_, "srv").Request, fields, self._now())
        self._client(service, type_)

    def call(self, service: str, type_: str, fields: Mapping[str, Any], timeout_s: float) -> Mapping[str, Any]:
        """Call a service.

        Raises:
            ActionError: nobody offers it, or answers in time.
        """
        request = filled(interface(type_, "srv").Request, fields, self._now())
        client = self._client(service, type_)
        end = time.monotonic() + timeout_s
        if not client.wait_for_service(timeout_sec=timeout_s):
            raise ActionError(
                f"no server offers {service} of the type {type_}", expected=f"a server within {timeout_s:g} s"
            )
        answered = threading.Event()
        future = client.call_async(request)
        future.add_done_callback(lambda _: answered.set())
        if not answered.wait(max(end - time.monotonic(), 0.1)):
            client.remove_pending_request(future)
            raise ActionError(f"{service} did not answer", expected=f"an answer within {timeout_s:g} s")
        found: Mapping[str, Any] = plain(future.result())
        return found

    def set_parameter(self, node: str, name: str, value: Any, timeout_s: float) -> None:
        """Set a parameter of a node.

        Raises:
            ActionError: it refuses, or does not answer.
        """
        fields = {"parameters": [parameter_fields(name, value)]}
        (result,) = self.call(f"{node}/set_parameters", _SET, fields, timeout_s)["results"]
        if not result["successful"]:
            raise ActionError(f"{node} does not take {name}: {value!r}: {result['reason'] or 'no reason given'}")

    def ready_to_log(self) -> None:
        """The node logs from its beginning on."""

    def log(self, level: str, text: str) -> None:
        """Publish a text on /rosout."""
        logger = self._node.get_logger()
        # One call site each: rclpy keeps the level of a site.
        if level == "error":
            logger.error(text)
        elif level == "warning":
            logger.warning(text)
        else:
            logger.info(text)

    def record(self, patterns: tuple[str, ...], before_s: float, path: str, after_s: float) -> str:
        """Keep what is said on some topics, and write it once there is a path; see ``live/act/ros.py``.

        Raises:
            ActionError: a pattern is none, or the recording cannot be written.
        """
        with self._lock:
            keeping = self._kept.get((patterns, before_s))
            if keeping is None:
                keeping = self._kept[patterns, before_s] = Keeping(before_s)
                self._listening.append(Listening(self._node, patterns, keeping.received))
        return keeping.write(path, "ros2", after_s) if path else "kept from now on"

    def close(self) -> None:
        """Stop receiving."""
        for one in self._listening:
            one.close()

    def _publisher(self, topic: str, type_: str, *, latched: bool) -> Any:
        from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

        durability = DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE
        profile = QoSProfile(
            depth=1 if latched else _DEPTH, reliability=ReliabilityPolicy.RELIABLE, durability=durability
        )
        with self._lock:
            key = (topic, type_, latched)
            if key not in self._publishers:
                self._publishers[key] = self._made(
                    lambda: self._node.create_publisher(interface(type_, "msg"), topic, profile), topic
                )
            return self._publishers[key]

    def _client(self, service: str, type_: str) -> Any:
        with self._lock:
            key = (service, type_)
            if key not in self._clients:
                self._clients[key] = self._made(
                    lambda: self._node.create_client(interface(type_, "srv"), service), service
                )
            return self._clients[key]

    def _made(self, make: Callable[[], Any], name: str) -> Any:
        try:
            return make()
        except ActionError:
            raise
        except Exception as error:  # noqa: BLE001 - of names and types that rclpy refuses there are many
            raise ActionError(f"{name!r}: {error}", expected="a name that ROS takes, and a type that fits it") from None

    def _now(self) -> tuple[int, int]:
        whole, part = divmod(round(self._wall() * 1e9), 1_000_000_000)
        return whole, part
