"""Counts messages on topics with rclpy, of whatever type the graph says; `tally_messages.py` says what it takes."""

import importlib
import os
import sys
import threading

import rclpy
from rclpy.qos import qos_profile_sensor_data
from tally_messages import Tally


def _message_class(name: str) -> type:
    package, _, kind = name.split("/")
    found: type = getattr(importlib.import_module(f"{package}.msg"), kind)
    return found


def main() -> int:
    """Subscribes to each topic as soon as it appears."""
    rclpy.init()
    node = rclpy.create_node("listener")
    tally = Tally(sys.argv[1:], bytes, stamp_at=4)  # what precedes is CDR's own header
    missing = set(tally.topics)

    def subscribe() -> None:
        for topic, types in node.get_topic_names_and_types():
            if topic in missing:
                missing.remove(topic)
                callback = tally.counter(topic)
                node.create_subscription(_message_class(types[0]), topic, callback, qos_profile_sensor_data, raw=True)

    node.create_timer(0.1, subscribe)
    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()
    return tally.report()


if __name__ == "__main__":
    code = main()
    sys.stderr.flush()
    os._exit(code)  # the spinning thread holds the context; nobody waits for its end
