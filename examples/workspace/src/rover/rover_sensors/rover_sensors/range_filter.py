# Copyright 2025 The roslens authors
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.

"""Takes outliers out of the ranges of the sonars and merges them into one scan."""

from __future__ import annotations

import math
from collections import deque
from functools import partial

import rclpy
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan, Range


class SlidingMedian:
    """The median of the last values; one that jumps too far from it is left out."""

    def __init__(self, size: int, largest_jump: float) -> None:
        self._values: deque[float] = deque(maxlen=size)
        self._largest_jump = largest_jump
        self._rejected = 0

    def add(self, value: float) -> float:
        """Take a value and return the median."""
        if self._values:
            middle = self.median()
            if abs(value - middle) > self._largest_jump:
                self._rejected += 1
                # A jump that stays is no outlier: believe it after half a window.
                if self._rejected < (self._values.maxlen or 1) // 2:
                    return middle
                self._values.clear()
        self._rejected = 0
        self._values.append(value)
        return self.median()

    def median(self) -> float:
        """Return the median of what was taken so far."""
        ordered = sorted(self._values)
        count = len(ordered)
        if count == 0:
            return 0.0
        if count % 2 == 1:
            return ordered[count // 2]
        return (ordered[count // 2 - 1] + ordered[count // 2]) / 2.0


class RangeFilter(Node):
    """Publishes ``scan`` with one beam for each sonar."""

    def __init__(self) -> None:
        super().__init__("range_filter")
        names = self.declare_parameter("sonars", ["front", "left", "rear", "right"]).value
        self._longest = self.declare_parameter("longest_m", 4.0).value
        self._filters = [SlidingMedian(size=7, largest_jump=0.8) for _ in names]
        self._ranges = [math.inf] * len(names)
        self._publisher = self.create_publisher(LaserScan, "scan", qos_profile_sensor_data)
        for number, name in enumerate(names):
            callback = partial(self._on_range, number)
            self.create_subscription(Range, f"sonar/{name}", callback, qos_profile_sensor_data)
        self.create_timer(0.1, self._on_timer)

    def _on_range(self, number: int, message: Range) -> None:
        if message.min_range <= message.range <= message.max_range:
            self._ranges[number] = self._filters[number].add(message.range)
        else:
            self._ranges[number] = math.inf

    def _on_timer(self) -> None:
        message = LaserScan()
        message.header.stamp = self.get_clock().now().to_msg()
        message.header.frame_id = "base_link"
        message.angle_increment = 2.0 * math.pi / len(self._ranges)
        message.angle_max = message.angle_increment * (len(self._ranges) - 1)
        message.range_min = 0.02
        message.range_max = self._longest
        message.ranges = self._ranges
        self._publisher.publish(message)


def main() -> None:
    """Run the node until it is interrupted."""
    rclpy.init()
    node = RangeFilter()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
