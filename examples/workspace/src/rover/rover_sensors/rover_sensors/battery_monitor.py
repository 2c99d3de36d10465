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

"""Turns the voltage that the motor board measures into the charge of the battery."""

from __future__ import annotations

from collections import deque

import rclpy
from rclpy.node import Node
from rclpy.qos import QoSDurabilityPolicy, QoSProfile
from rover_msgs.msg import MotorStatus
from sensor_msgs.msg import BatteryState

from rover_sensors.battery_curve import charge_of

RESISTANCE_OHM = 0.045
"""Of battery and cables; the voltage sags by this much per ampere."""


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


class BatteryMonitor(Node):
    """Publishes ``battery`` and warns once for each threshold that is passed."""

    def __init__(self) -> None:
        super().__init__("battery_monitor")
        self._warn_at = self.declare_parameter("warn_at", 0.25).value
        self._stop_at = self.declare_parameter("stop_at", 0.10).value
        self._voltage = SlidingMedian(size=15, largest_jump=1.5)
        self._warned: set[str] = set()
        latched = QoSProfile(depth=1, durability=QoSDurabilityPolicy.TRANSIENT_LOCAL)
        self._publisher = self.create_publisher(BatteryState, "battery", latched)
        self.create_subscription(MotorStatus, "motor_status", self._on_status, 10)

    def _on_status(self, status: MotorStatus) -> None:
        resting = status.voltage_v + status.current_a * RESISTANCE_OHM
        voltage = self._voltage.add(resting)
        message = BatteryState()
        message.header = status.header
        message.voltage = voltage
        message.current = -status.current_a
        message.percentage = charge_of(voltage)
        message.present = True
        self._publisher.publish(message)
        self._warn(message.percentage)

    def _warn(self, charge: float) -> None:
        if charge < self._stop_at and "stop" not in self._warned:
            self._warned.add("stop")
            self.get_logger().error(f"battery at {charge:.0%}: drive home now")
        elif charge < self._warn_at and "warn" not in self._warned:
            self._warned.add("warn")
            self.get_logger().warning(f"battery at {charge:.0%}")


def main() -> None:
    """Run the node until it is interrupted."""
    rclpy.init()
    node = BatteryMonitor()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
