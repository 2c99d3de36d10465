"""Makes many nodes of ROS 2 in one process: PROGRAM FIRST COUNT TOPICS NODES.

Nodes FIRST to FIRST + COUNT - 1 of NODES: each publishes TOPICS topics of its own and subscribes to those of the next.
A line is written when all are there; then each topic gets a message every two seconds, until the process is ended.
"""

import sys

import rclpy
from rclpy.executors import SingleThreadedExecutor
from std_msgs.msg import Float64, Header, String

TYPES = (Header, String, Float64)
PERIOD_S = 2.0


def main(first: int, count: int, topics: int, nodes: int) -> None:
    """Makes the nodes and spins them."""
    rclpy.init()
    executor = SingleThreadedExecutor()
    publishers = []
    for number in range(first, first + count):
        node = rclpy.create_node(f"n{number}", namespace=f"/large/g{number % 10}")
        after = (number + 1) % nodes
        for topic in range(topics):
            kind = TYPES[topic % len(TYPES)]
            publishers.append((node.create_publisher(kind, f"/large/t{number}_{topic}", 10), kind()))
            node.create_subscription(kind, f"/large/t{after}_{topic}", lambda message: None, 10)
        executor.add_node(node)

    def publish() -> None:
        for publisher, message in publishers:
            publisher.publish(message)

    node.create_timer(PERIOD_S, publish)
    sys.stdout.write("there\n")
    sys.stdout.flush()
    executor.spin()


if __name__ == "__main__":
    main(*map(int, sys.argv[1:5]))
