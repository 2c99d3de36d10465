"""The process that acts in a ROS 2 system: orders on standard input, replies on standard output."""

from __future__ import annotations

import argparse
import os
import sys
import threading
from typing import Any

from roslens.live.act.order_line import serve
from roslens.live.act.orders import Orders
from roslens.live.adapters.ros2.far_peers import far_peers
from roslens.live.adapters.ros2.hand import Ros2Hand

_NAME = "_roslens_hand_"


def main(words: list[str]) -> int:
    """Act until standard input ends; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m roslens.live.adapters.ros2.acting", description=__doc__)
    parser.add_argument("--domain", type=int, metavar="N", help="domain id (default: that of the environment)")
    options = parser.parse_args(words)
    # What libraries print must not get between the replies.
    replies = os.dup(1)
    os.dup2(2, 1)
    import rclpy
    from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
    from rclpy.signals import SignalHandlerOptions

    with far_peers(os.environ, options.domain):
        rclpy.init(args=[], domain_id=options.domain, signal_handler_options=SignalHandlerOptions.NO)
        node: Any = rclpy.create_node(f"{_NAME}{os.getpid()}", namespace="/", start_parameter_services=False)
    executor = SingleThreadedExecutor()
    executor.add_node(node)

    def spin() -> None:
        try:
            executor.spin()
        except ExternalShutdownException:
            return

    spinning = threading.Thread(target=spin, name="spin", daemon=True)
    spinning.start()
    hand = Ros2Hand(node)
    try:
        serve(0, replies, lambda say: Orders(hand, say))
    finally:
        hand.close()
        rclpy.try_shutdown()
        spinning.join(1.0)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
