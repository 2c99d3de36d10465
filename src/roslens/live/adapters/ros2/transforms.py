"""The process that listens to transforms of a ROS 2 system for a while: a document on standard output, then it ends."""

from __future__ import annotations

import argparse
import importlib
import os
import sys
import time
from typing import Any

import msgspec

from roslens.live.adapters.ros2.graph import OWN
from roslens.model.transforms.heard import HeardTransforms
from roslens.model.transforms.transform import Transform, frame_name

TYPE = "tf2_msgs/msg/TFMessage"
MOST = 100_000
"""Transforms that are kept; then it ends at once, and says since when it listened."""
PATIENCE_S = 2.0
"""How much longer it is waited where no topic of transforms is found: who is there, is not known at once."""
DEPTH = 1000
_STATIC = "tf_static"
_SECOND = 1_000_000_000
_LOOK_S = 0.02
_FIND_S = 0.1


def main(words: list[str]) -> int:
    """Listen, write, and return the exit code: 3 where the messages of tf2 are not in this Python."""
    parser = argparse.ArgumentParser(prog="python -m roslens.live.adapters.ros2.transforms", description=__doc__)
    parser.add_argument("--domain", type=int, metavar="N", help="domain id (default: that of the environment)")
    parser.add_argument("--for", dest="seconds", type=float, default=2.0, metavar="S", help="seconds to listen for")
    options = parser.parse_args(words)
    # What libraries print must not get into the document.
    result = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    try:
        kind = importlib.import_module("tf2_msgs.msg").TFMessage
    except ImportError as error:
        sys.stderr.write(f"the Python of the observer has no tf2_msgs ({error})\n")
        return 3
    with result:
        result.write(msgspec.msgpack.encode(_listened(options.domain, options.seconds, kind)))
    return 0


def _listened(domain: int | None, seconds: float, kind: Any) -> HeardTransforms:
    import rclpy
    from rclpy.signals import SignalHandlerOptions

    rclpy.init(args=[], domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
    node: Any = rclpy.create_node(
        f"{OWN[1:]}transforms{os.getpid()}", namespace="/", enable_rosout=False, start_parameter_services=False
    )
    try:
        return _Ear(node, kind).listen(seconds)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


class _Ear:
    """Subscribes to each topic of transforms as it is found, and takes what comes without an executor."""

    def __init__(self, node: Any, kind: Any) -> None:
        self._node = node
        self._kind = kind
        self._open: dict[str, Any] = {}
        self._heard: list[Transform] = []

    def listen(self, seconds: float) -> HeardTransforms:
        """Listen for so long from when the last of the topics was found."""
        begun, due = time.time(), 0.0
        end = begun + seconds + PATIENCE_S
        while (now := time.time()) < end and len(self._heard) < MOST:
            if now >= due:
                due = now + _FIND_S
                if self._find():
                    end = now + seconds
            for topic, subscription in self._open.items():
                self._drain(topic, subscription)
            time.sleep(_LOOK_S)
        return HeardTransforms(begun, time.time(), tuple(sorted(self._open)), tuple(self._heard))

    def _find(self) -> bool:
        """Subscribe to topics that were not there before; return whether there were any."""
        from rclpy.qos import QoSDurabilityPolicy, QoSProfile, QoSReliabilityPolicy

        before = len(self._open)
        for name, types in self._node.get_topic_names_and_types():
            if TYPE not in types or name in self._open:
                continue
            if name.rpartition("/")[2] == _STATIC:
                quality = QoSProfile(
                    depth=DEPTH, durability=QoSDurabilityPolicy.TRANSIENT_LOCAL,
                    reliability=QoSReliabilityPolicy.RELIABLE,
                )  # fmt: skip
            else:
                quality = QoSProfile(depth=DEPTH, reliability=QoSReliabilityPolicy.BEST_EFFORT)
            self._open[name] = self._node.create_subscription(self._kind, name, _nothing, quality)
        return len(self._open) > before

    def _drain(self, topic: str, subscription: Any) -> None:
        static = topic.rpartition("/")[2] == _STATIC
        while len(self._heard) < MOST and (taken := subscription.handle.take_message(self._kind, False)) is not None:
            message, received = taken[0], time.time_ns()
            for one in message.transforms:
                stamp, place, turn = one.header.stamp, one.transform.translation, one.transform.rotation
                self._heard.append(
                    Transform(
                        frame_name(one.header.frame_id), frame_name(one.child_frame_id),
                        stamp.sec * _SECOND + stamp.nanosec, (place.x, place.y, place.z),
                        (turn.x, turn.y, turn.z, turn.w), static, received,
                    )
                )  # fmt: skip


def _nothing(_: object) -> None:
    """Never called: the node is not spun."""


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
